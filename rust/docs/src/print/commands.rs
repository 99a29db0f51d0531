//! The commands of `msdd`, from what clap prints as their help.

use super::markdown::{prose, table};
use crate::error::DocsError;
use clap::{Arg, ArgAction, Command};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::Path;

/// A list of all commands, and a section for each: what it does, its usage, its options and examples.
///
/// # Errors
/// An argument: there is none.
pub fn text(_root: &Path, argument: &str) -> Result<String, DocsError> {
    if !argument.is_empty() {
        return Err(DocsError::Print(format!("'{argument}': all commands are printed, without an argument")));
    }
    let mut root = msdd_cli::command();
    root.build();
    let mut leaves = Vec::new();
    collect(&root, &mut leaves);
    let names: BTreeSet<String> = leaves.iter().map(|leaf| name(leaf)).collect();
    let plain = |text: &str| prose(text, is_code, |code| names.contains(code).then(|| anchor(code)));
    let overview: Vec<Vec<String>> = leaves
        .iter()
        .map(|leaf| vec![plain(&format!("`{}`", name(leaf))), plain(&about(leaf, false))])
        .collect();
    let sections: String = leaves.iter().map(|leaf| section(leaf, &plain)).collect();
    Ok(table(&["command", "what it does"], &overview) + "\n" + &sections)
}

/// The commands that have none below them.
fn collect<'a>(command: &'a Command, leaves: &mut Vec<&'a Command>) {
    let below: Vec<&Command> = command
        .get_subcommands()
        .filter(|below| below.get_name() != "help" && !below.is_hide_set())
        .collect();
    if below.is_empty() {
        leaves.push(command);
    }
    below.into_iter().for_each(|below| collect(below, leaves));
}

fn name(command: &Command) -> String {
    command.get_bin_name().unwrap_or_else(|| command.get_name()).to_string()
}

fn anchor(name: &str) -> String {
    name.replace(' ', "-")
}

fn is_code(word: &str) -> bool {
    word.starts_with("--") && word.len() > 2
}

/// The first sentence or, with `long`, all that the help says before the usage.
fn about(command: &Command, long: bool) -> String {
    let text = command.get_long_about().filter(|_| long).or(command.get_about());
    let text = text.map(ToString::to_string).unwrap_or_default();
    if text.ends_with('.') || !long { text } else { format!("{text}.") }
}

fn section(command: &Command, plain: &dyn Fn(&str) -> String) -> String {
    let usage = command.clone().render_usage().to_string().replace("Usage: ", "");
    let mut out =
        format!("### {}\n\n{}\n\n```text\n{usage}\n```\n\n", name(command), plain(&about(command, true)));
    for heading in headings(command) {
        if let Some(heading) = heading {
            let _ = writeln!(out, "**{}**\n", plain(heading));
        }
        let shown = command.get_arguments().filter(|arg| arg.get_help_heading() == heading && is_own(arg));
        let rows: Vec<Vec<String>> = shown.map(|arg| row(arg, plain)).collect();
        let _ = writeln!(out, "{}", table(&["option", "meaning", "allowed", "default"], &rows));
    }
    for part in command.get_after_help().map(ToString::to_string).unwrap_or_default().split("\n\n") {
        // Examples and lists keep their lines.
        let literal = part.starts_with("Example") || part.lines().any(|line| line.starts_with("  "));
        let _ = match literal {
            true => writeln!(out, "```text\n{part}\n```\n"),
            false => writeln!(out, "{}\n", plain(part)),
        };
    }
    out
}

fn is_own(arg: &Arg) -> bool {
    !arg.is_hide_set()
        && !matches!(arg.get_action(), ArgAction::Help | ArgAction::HelpShort | ArgAction::Version)
}

/// The headings under which options stand, in their order.
fn headings(command: &Command) -> Vec<Option<&str>> {
    let mut headings = Vec::new();
    for arg in command.get_arguments().filter(|arg| is_own(arg)) {
        if !headings.contains(&arg.get_help_heading()) {
            headings.push(arg.get_help_heading());
        }
    }
    headings
}

/// Name, meaning, allowed values and default. A comment that ends with 'Allowed: …. Default: ….' gives the last two.
fn row(arg: &Arg, plain: &dyn Fn(&str) -> String) -> Vec<String> {
    let help = arg.get_long_help().or(arg.get_help()).map(ToString::to_string).unwrap_or_default();
    let (help, default) = cut(&help, "efault: ");
    let (help, allowed) = cut(&help, "llowed: ");
    let default = match default {
        Some(text) => plain(&text),
        None if arg.is_required_set() => "required".to_string(),
        None if !arg.get_action().takes_values() => String::new(),
        None => {
            let values: Vec<_> =
                arg.get_default_values().iter().map(|value| value.to_string_lossy()).collect();
            if values.is_empty() { String::new() } else { format!("`{}`", values.join(" ")) }
        }
    };
    let allowed =
        allowed.map(|text| plain(&text)).or_else(|| values(arg)).or_else(|| range(arg)).unwrap_or_default();
    let aliases = arg.get_visible_aliases().unwrap_or_default();
    let aliases: String = aliases.iter().map(|alias| format!(", `--{alias}`")).collect();
    vec![format!("`{}`{aliases}", shown(arg)), plain(&help), allowed, default]
}

/// The text before a mark such as 'Default: ', and that behind it.
fn cut(text: &str, mark: &str) -> (String, Option<String>) {
    let Some(at) = text.find(mark) else { return (text.to_string(), None) };
    let before =
        text[..at].trim_end_matches(|c: char| c.is_alphabetic()).trim_end_matches([' ', '.', ';', ',']);
    (before.to_string(), Some(text[at + mark.len()..].trim_end_matches('.').to_string()))
}

/// `--name VALUE`, or `<NAME>...` of an argument without a name.
fn shown(arg: &Arg) -> String {
    let values =
        arg.get_value_names().unwrap_or_default().iter().map(ToString::to_string).collect::<Vec<_>>();
    let many = if matches!(arg.get_action(), ArgAction::Append) { "..." } else { "" };
    match (arg.get_long(), arg.get_action().takes_values()) {
        (Some(long), true) => format!("--{long} {}", values.join(" ")),
        (Some(long), false) => format!("--{long}"),
        _ => format!("<{}>{many}", values.join(" ")),
    }
}

/// The values that clap lists.
fn values(arg: &Arg) -> Option<String> {
    let values = arg.get_possible_values();
    let names: Vec<String> = values.iter().map(|value| format!("`{}`", value.get_name())).collect();
    (!names.is_empty() && arg.get_action().takes_values()).then(|| names.join(", "))
}

/// The range of whole numbers that the argument takes: clap gives it when it refuses a value, and in no other way.
fn range(arg: &Arg) -> Option<String> {
    let refused = |value: &String| {
        let probed = Arg::new("value").long("value").value_parser(arg.get_value_parser().clone());
        let given = format!("--value={value}");
        let error =
            Command::new("probe").arg(probed).try_get_matches_from(["probe", &given]).err()?.to_string();
        Some(error.split_once(" is not in ")?.1.split_whitespace().next()?.to_string())
    };
    let probes = ["0".to_string(), i64::MIN.to_string(), u64::MAX.to_string()];
    let range = probes.iter().filter(|_| arg.get_action().takes_values()).find_map(refused)?;
    let (least, most) = range.split_once("..")?;
    let most = most.trim_start_matches('=');
    let unbounded = most.is_empty() || most == u32::MAX.to_string();
    Some(if unbounded { format!("≥ {least}") } else { format!("{least} to {most}") })
}
