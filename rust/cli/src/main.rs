//! The program `msdd`; everything is in the library, from which the book's page of commands is printed.
#![forbid(unsafe_code)]

fn main() -> std::process::ExitCode {
    msdd_cli::run()
}
