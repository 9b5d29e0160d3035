//! `--package` and `--arg`: the packages and arguments of a robot description. Main type: [`DescriptionArguments`].

use std::path::PathBuf;

use groebot_robot::model::ReadOptions;

/// The packages and arguments of a robot description.
#[derive(clap::Args)]
pub struct DescriptionArguments {
    /// The folder of a package that the description names by $(find NAME) or package://NAME (repeatable; default: also
    /// those in ROS_PACKAGE_PATH and AMENT_PREFIX_PATH)
    #[arg(long, value_name = "NAME=FOLDER", value_parser = package)]
    package: Vec<(String, PathBuf)>,
    /// The value of an argument of a description in xacro (repeatable)
    #[arg(long, value_name = "NAME:=VALUE", value_parser = argument)]
    arg: Vec<(String, String)>,
}

impl DescriptionArguments {
    /// The options for the reader of the description.
    pub fn options(&self) -> ReadOptions {
        let packages = self.package.iter().cloned();
        let options =
            packages.fold(ReadOptions::from_environment(), |options, (name, path)| options.package(name, path));
        self.arg.iter().cloned().fold(options, |options, (name, value)| options.argument(name, value))
    }
}

fn package(text: &str) -> std::result::Result<(String, PathBuf), String> {
    let parts = text.split_once(":=").or_else(|| text.split_once('='));
    let parts = parts.filter(|(name, path)| !name.is_empty() && !path.is_empty());
    let (name, path) = parts.ok_or("give NAME=FOLDER, such as ur_description=/opt/ur_description")?;
    let path = PathBuf::from(path);
    if path.is_dir() {
        Ok((name.to_owned(), path))
    } else {
        Err("there is no such folder; give NAME=FOLDER".to_owned())
    }
}

fn argument(text: &str) -> std::result::Result<(String, String), String> {
    let parts = text.split_once(":=").filter(|(name, _)| !name.is_empty());
    let (name, value) = parts.ok_or("give NAME:=VALUE, such as ur_type:=ur5e")?;
    Ok((name.to_owned(), value.to_owned()))
}
