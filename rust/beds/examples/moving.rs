//! A bed whose walls move, as `msdd bed run` computes it, without the rest of that program: the folder with bed.toml, the file
//! to write, threads.
//!
//! ```sh
//! cargo run --release -p msdd-beds --example moving -- cases/column dem.csv 1
//! ```

use msdd_beds::case::BedCase;
use msdd_beds::coupled::{prepare, run};
use msdd_beds::rows::elements;
use std::path::Path;
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [folder, file, threads] = arguments.as_slice() else {
        return Err("usage: moving FOLDER FILE THREADS".into());
    };
    let scene = BedCase::read(Path::new(folder))?;
    let begin = Instant::now();
    let prepared = prepare(&scene, threads.parse()?, |_, _| ())?;
    println!("prepared after {:.0} s", begin.elapsed().as_secs_f64());
    let found = run(&scene, &prepared, |_| ())?;
    std::fs::write(file, elements(&scene, &prepared, &found))?;
    println!("{} steps, {:.0} s", found.steps, begin.elapsed().as_secs_f64());
    Ok(())
}
