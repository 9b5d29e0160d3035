//! The help page with its commands by subject, and `groebot completions`.

use clap::{Command, CommandFactory};
use clap_complete::{Shell, generate};

use super::{Cli, Outcome, console};

/// The commands of the help page, by subject.
const SUBJECTS: [(&str, &[&str]); 6] = [
    ("Kinematics", &["robots", "info", "derive", "check", "solve", "follow", "ik", "fk", "plan", "reach", "codegen"]),
    ("Algebra", &["basis", "explain"]),
    ("Dynamics and control", &["dynamics", "identify", "track"]),
    ("Walking and navigation", &["walk", "navigate", "task", "path", "simulate"]),
    ("Pictures and exchange", &["view", "export"]),
    ("Shell", &["completions", "help"]),
];

/// The command line with its help page.
pub fn command() -> Command {
    let mut command = Cli::command();
    // Adds the command `help`.
    command.build();
    let text = subjects(&command);
    let heading = command.get_styles().get_header();
    let options = format!("{heading}Options:{heading:#}");
    command.help_template(format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{text}{options}\n{{options}}{{after-help}}"
    ))
}

/// The commands with their summaries, by subject.
fn subjects(command: &Command) -> String {
    let (heading, literal) = (command.get_styles().get_header(), command.get_styles().get_literal());
    let width = command.get_subcommands().map(|one| one.get_name().len()).max().unwrap_or(0);
    let line = |name: &&str| {
        let about = command.find_subcommand(name).and_then(Command::get_about).map(ToString::to_string);
        let about = about.as_deref().and_then(|text| text.split([':', ';']).next()).unwrap_or_default().to_owned();
        format!("  {literal}{name:width$}{literal:#}  {about}\n")
    };
    let subject = |(title, names): &(&str, &[&str])| {
        let lines: String = names.iter().map(line).collect();
        format!("{heading}{title}:{heading:#}\n{lines}\n")
    };
    SUBJECTS.iter().map(subject).collect()
}

const EXAMPLES: &str = "Examples:
  groebot completions bash > ~/.local/share/bash-completion/completions/groebot
  groebot completions zsh > ~/.zfunc/_groebot          with `fpath+=~/.zfunc` before `compinit` in ~/.zshrc
  groebot completions fish > ~/.config/fish/completions/groebot.fish";

/// Prints a script that completes groebot's commands and options in a shell
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The shell
    shell: Shell,
}

/// Prints the script.
pub fn run(arguments: &Arguments) -> Outcome {
    let mut script = Vec::new();
    generate(arguments.shell, &mut Cli::command(), "groebot", &mut script);
    console::print(&String::from_utf8_lossy(&script))
}
