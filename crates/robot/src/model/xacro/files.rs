//! Included files, `$(...)`, and the functions of expressions that read files and arguments.

use std::fs;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use super::budget::Budget;
use super::expand::{Expander, Output, expression_error, folder_of, truth};
use super::expression::{Context, Value, eval_function, evaluate, parse_float, parse_int};
use super::node::{Element, Location};
use super::scope::{Named, Scope, Symbol};
use super::yaml;
use crate::document::{decode_xml, read_bytes, refuse_binary, shown, text_of};
use crate::{Error, ErrorKind, Result};

/// Maximum number of files of a pattern.
const MATCHES: usize = 1000;
/// The commands of `$(...)`.
const COMMANDS: &str = "give $(arg NAME), $(find PACKAGE), $(dirname), $(optenv NAME VALUE) or $(eval EXPRESSION)";

impl Expander<'_> {
    /// `xacro:include`: expands the elements of other files.
    pub fn include(&mut self, element: &Element, scope: Scope, out: &mut Output) -> Result<()> {
        let name = self.string(self.required(element, "filename")?, scope.symbols)?;
        let inner = match element.attribute("ns").filter(|name| !name.is_empty()) {
            Some(namespace) => {
                let namespace = self.string(namespace, scope.symbols)?;
                self.namespace(&namespace, scope)
            }
            None => scope,
        };
        let is_optional = element.attribute("optional").map_or(Ok(false), truth)?;
        for path in self.matches(&name, element.location)? {
            self.budget.spend(0)?;
            let Some(real) = self.packages.allowed(&path)? else {
                if is_optional {
                    continue;
                }
                let text = format!("includes `{}`, which does not exist", shown(&path.to_string_lossy()));
                return Err(self.error(element, ErrorKind::Io, &text));
            };
            let root = self.parse(&path, &real)?;
            self.stack.push(path);
            self.content(&root.children, inner, out)?;
            self.stack.pop();
        }
        Ok(())
    }

    /// The scope of an include with the namespace `name`.
    fn namespace(&mut self, name: &str, scope: Scope) -> Scope {
        let macros = self.macros.add(None, true);
        let symbols = self.symbols.add(Some(scope.symbols), true);
        self.macros.set(scope.macros, name, Named::Namespace(macros));
        self.symbols.set(scope.symbols, name, Symbol::Value(Value::Namespace(symbols)));
        Scope { macros, symbols }
    }

    /// Reads and parses the file `path`, which is the file `real` without symbolic links.
    ///
    /// # Errors
    /// As [`read_bytes`], [`decode_xml`] and [`Element::parse`], with the file; above the limits.
    fn parse(&mut self, path: &Path, real: &Path) -> Result<Rc<Element>> {
        let bytes = read_bytes(real, self.budget.input()).map_err(|error| error.in_file(path))?;
        self.budget.spend_file(bytes.len() as u64)?;
        let file = self.files.iter().position(|known| known == path).unwrap_or(self.files.len());
        if file == self.files.len() {
            self.files.push(path.to_owned());
        }
        let xml = refuse_binary(&bytes).and_then(|()| decode_xml(&bytes)).map_err(|error| error.in_file(path))?;
        let root = Element::parse(&xml.text, file).map_err(|error| error.in_file(path))?;
        Ok(Rc::new(root))
    }

    /// The path for the name of a file: relative names are in the folder of the current file.
    fn path(&mut self, name: &str) -> Result<PathBuf> {
        let plain = name.strip_prefix("file://").unwrap_or(name);
        if let Some(rest) = plain.strip_prefix("package://") {
            let (package, inner) = rest.split_once('/').unwrap_or((rest, ""));
            return Ok(self.packages.find(package)?.join(inner));
        }
        Ok(self.folder().join(plain))
    }

    /// The folder of the current file.
    fn folder(&self) -> PathBuf {
        self.stack.last().map_or_else(PathBuf::new, |file| folder_of(file))
    }

    /// The files for a name in which `*` and `?` of the last part match any letters, sorted.
    fn matches(&mut self, name: &str, location: Location) -> Result<Vec<PathBuf>> {
        let path = self.path(name)?;
        let pattern = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        if !pattern.contains(['*', '?']) {
            return Ok(vec![path]);
        }
        let folder = path.parent().map(Path::to_owned).unwrap_or_default();
        let entries = fs::read_dir(&folder).into_iter().flatten().flatten();
        let named = entries.map(|entry| entry.path()).filter(|path| {
            path.file_name().is_some_and(|name| is_match(pattern.as_bytes(), name.to_string_lossy().as_bytes()))
        });
        let mut paths: Vec<PathBuf> = named.take(MATCHES).collect();
        paths.sort();
        if paths.is_empty() {
            self.note(location, &format!("no file is included by `{}`", shown(name)));
        }
        Ok(paths)
    }

    /// The value of `$(inner)`.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for an unknown argument or package; [`ErrorKind::Unsupported`] for environment
    /// variables and unknown commands; those of [`evaluate`].
    pub fn command(&mut self, inner: &str, symbols: usize) -> Result<Value> {
        let inner = self.string(inner, symbols)?;
        if let Some(expression) = inner.strip_prefix("eval ") {
            let value = evaluate(expression.trim(), &mut Arguments { expander: self });
            let value = value.map_err(|error| expression_error(error, "$(eval ", expression, ")"))?;
            return value.shown(&mut self.budget).map(Value::Text);
        }
        let words: Vec<&str> = inner.split_whitespace().collect();
        let text = match words.as_slice() {
            ["arg", name] => self.argument_text(name)?,
            ["find", package] => self.packages.find(package)?.to_string_lossy().into_owned(),
            ["dirname"] => self.folder().to_string_lossy().into_owned(),
            ["optenv", name, default @ ..] => self.unread(name, &default.join(" ")),
            ["env", name, ..] => return Err(refuse_variable(name)),
            _ => {
                let text = format!("`$({})` is not a command; {COMMANDS}", shown(&inner));
                return Err(Error::new(ErrorKind::Unsupported, text));
            }
        };
        self.budget.spend_length(text.len())?;
        Ok(Value::text(text))
    }

    /// The default of an environment variable. Variables are never read, so that a description has one meaning.
    fn unread(&mut self, name: &str, default: &str) -> String {
        let note = format!("`$(optenv {})` has its default: environment variables are not read", shown(name));
        if !self.notes.contains(&note) {
            self.notes.push(note);
        }
        default.to_owned()
    }

    fn argument_text(&self, name: &str) -> Result<String> {
        let missing = || {
            let text = format!(
                "the argument `{}` has no value; give `--arg {}:=VALUE`, or a default in a <xacro:arg> before this place",
                shown(name),
                shown(name)
            );
            Error::new(ErrorKind::UnknownName, text)
        };
        self.arguments.get(name).cloned().ok_or_else(missing)
    }

    /// The value of a function of `${...}` that reads files or arguments, or writes a note.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for wrong arguments, and for `xacro.fatal`; those of the files.
    pub fn function(&mut self, function: &'static str, arguments: &[Value]) -> Result<Value> {
        match (function, arguments) {
            ("load_yaml", [Value::Text(name)]) => self.load_yaml(name),
            ("abs_filename", [Value::Text(name)]) => Ok(Value::text(self.path(name)?.to_string_lossy().into_owned())),
            ("arg", [Value::Text(name)]) => self.argument_text(name).map(Value::text),
            ("print_location", _) => Ok(Value::text("")),
            ("message" | "warning" | "error" | "fatal", _) => {
                let mut words = Vec::new();
                for argument in arguments {
                    words.push(argument.shown(&mut self.budget)?.to_string());
                }
                let text = format!("the description reports: {}", shown(&words.join(" ")));
                if function == "fatal" {
                    return Err(Error::new(ErrorKind::BadValue, text));
                }
                if self.notes.len() < MATCHES && !self.notes.contains(&text) {
                    self.notes.push(text);
                }
                Ok(Value::text(""))
            }
            _ => {
                let text = format!("`{function}` is not available here, or does not take these arguments");
                Err(Error::new(ErrorKind::Unsupported, text))
            }
        }
    }

    /// The values in a YAML file.
    fn load_yaml(&mut self, name: &str) -> Result<Value> {
        let path = self.path(name)?;
        let real = self.packages.allowed(&path)?.ok_or_else(|| {
            let text = format!("the file `{}` does not exist", shown(&path.to_string_lossy()));
            Error::new(ErrorKind::Io, text)
        })?;
        let bytes = read_bytes(&real, self.budget.input()).map_err(|error| error.in_file(&path))?;
        self.budget.spend_file(bytes.len() as u64)?;
        if bytes.iter().all(u8::is_ascii_whitespace) {
            return Ok(Value::None);
        }
        let text = text_of(bytes).map_err(|error| error.in_file(&path))?;
        yaml::parse(&text, &mut self.budget).map_err(|error| error.in_file(&path))
    }
}

fn refuse_variable(name: &str) -> Error {
    let text = format!(
        "the environment variable `{}` is not read: a description has the same meaning in each environment; use an argument, $(arg NAME)",
        shown(name)
    );
    Error::new(ErrorKind::Unsupported, text)
}

/// Whether `name` matches `pattern`, in which `*` is any text and `?` any byte.
fn is_match(pattern: &[u8], name: &[u8]) -> bool {
    let (mut p, mut n) = (0, 0);
    let mut star: Option<(usize, usize)> = None;
    while n < name.len() {
        match pattern.get(p) {
            Some(b'*') => {
                star = Some((p, n));
                p += 1;
            }
            Some(c) if *c == b'?' || *c == name[n] => (p, n) = (p + 1, n + 1),
            _ => match star {
                Some((at, from)) => {
                    star = Some((at, from + 1));
                    (p, n) = (at + 1, from + 1);
                }
                None => return false,
            },
        }
    }
    pattern[p..].iter().all(|c| *c == b'*')
}

/// The names of `$(eval ...)`: the arguments, and the functions of commands.
struct Arguments<'e, 'o> {
    expander: &'e mut Expander<'o>,
}

impl Context for Arguments<'_, '_> {
    fn budget(&mut self) -> &mut Budget {
        &mut self.expander.budget
    }

    fn name(&mut self, name: &str) -> Result<Option<Value>> {
        Ok(match name {
            "true" => Some(Value::Bool(true)),
            "false" => Some(Value::Bool(false)),
            _ => eval_function(name).or_else(|| self.expander.arguments.get(name).map(|text| automatic(text))),
        })
    }

    fn member(&mut self, _: usize, _: &str) -> Result<Option<Value>> {
        Ok(None)
    }

    fn call(&mut self, function: &'static str, arguments: &[Value]) -> Result<Value> {
        match (function, arguments) {
            ("arg", [Value::Text(name)]) => self.expander.argument_text(name).map(|text| automatic(&text)),
            ("find", [Value::Text(name)]) => {
                let path = self.expander.packages.find(name)?;
                Ok(Value::text(path.to_string_lossy().into_owned()))
            }
            ("dirname", []) => Ok(Value::text(self.expander.folder().to_string_lossy().into_owned())),
            ("optenv", [Value::Text(name)]) => Ok(Value::text(self.expander.unread(name, ""))),
            ("optenv", [Value::Text(name), Value::Text(default)]) => {
                Ok(Value::text(self.expander.unread(name, default)))
            }
            ("env", [Value::Text(name)]) => Err(refuse_variable(name)),
            _ => self.expander.function(function, arguments),
        }
    }
}

/// The value of an argument in `$(eval ...)`: a number, a truth value or a text.
fn automatic(text: &str) -> Value {
    let number = if text.contains('.') { parse_float(text).map(Value::Float) } else { parse_int(text).map(Value::Int) };
    number.unwrap_or_else(|| match text.to_ascii_lowercase().as_str() {
        "true" => Value::Bool(true),
        "false" => Value::Bool(false),
        _ => Value::text(text),
    })
}
