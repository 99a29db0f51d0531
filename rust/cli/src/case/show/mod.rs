//! `msdd case show`: a page with the results of a run.

mod animation;
mod curves;
mod maps;
mod page;
mod picture;
mod run;
mod units;
mod walls;

use crate::error::CliError;
use clap::Args;
use run::Run;
use std::path::PathBuf;

/// Most figures of a picture next to each other.
const COLUMNS: usize = 3;

#[derive(Args)]
#[command(
    after_help = "The page is one HTML file that needs no network: open it in a browser, print it or send it. It has
- key numbers: temperatures, stress, conductivity, outlet, pressure drop, heat, duration, and each wall;
- accuracy and warnings: the last lines of its log, and the warnings of its start;
- maps at three times: T, gasTemperature, pressure, conductivity, D and porosity, where they were written;
- T at the probes over time, with its 90 % band after 'msdd case solve'; T along the bed;
- stress and heat flux on the walls; outlet and pressure drop of a gas; the balance of heat.
A wedge is mirrored to the whole section, a mesh in space is cut in the middle. All regions are drawn; numbers refer to the bed.
A run that is still at work is shown with the times that are written. Binary fields are read, binary meshes are not.

Examples:
  msdd case show cases/H                              writes cases/H/show.html
  msdd case show bed --times 0,600,3600               maps at other times
  msdd case show bed --animate                        with maps that move
  msdd case show bed --png bed.png                    and the maps as a picture
  msdd case show bed --svg bed.svg --figures T,outlet some figures as a picture"
)]
pub struct Arguments {
    /// The case folder.
    folder: PathBuf,
    /// The page. Default: show.html in the case folder.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Times at which maps are drawn [s], with commas; of each the nearest written one is taken. Default: three, to the end.
    #[arg(long, value_name = "T,...", value_delimiter = ',', allow_negative_numbers = true)]
    times: Vec<f64>,
    /// Add maps that move: a slider and a button for at most 60 of the written times.
    #[arg(long)]
    animate: bool,
    /// Write the maps as one PNG picture, too.
    #[arg(long, value_name = "FILE")]
    png: Option<PathBuf>,
    /// Write the maps as one SVG picture, too.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Figures of --png and --svg, in this order, with commas. Default: all maps.
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', value_parser = page::names())]
    figures: Vec<String>,
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let run = Run::read(&arguments.folder, &arguments.times)?;
    let out = arguments.out.clone().unwrap_or_else(|| arguments.folder.join("show.html"));
    if arguments.png.is_some() || arguments.svg.is_some() {
        pictures(&run, arguments)?;
    }
    msdd_files::write(&out, page::text(&run, arguments.animate)?.as_bytes())?;
    outln!("{}", out.display());
    Ok(())
}

/// The figures that are wanted as one picture.
fn pictures(run: &Run, arguments: &Arguments) -> Result<(), CliError> {
    let all = page::figures(run, msdd_draw::map::SHADES, false)?;
    let maps: Vec<String> = maps::QUANTITIES.iter().map(|quantity| quantity.field.to_string()).collect();
    let wanted = if arguments.figures.is_empty() { &maps } else { &arguments.figures };
    if let Some(name) = arguments.figures.iter().find(|name| all.iter().all(|figure| figure.0 != **name)) {
        let there: Vec<&str> = all.iter().map(|figure| figure.0).collect();
        return Err(CliError::Message(format!(
            "--figures = {name}, allowed for this run: {}",
            there.join(", ")
        )));
    }
    let figures: Vec<&String> = (wanted.iter())
        .flat_map(|name| all.iter().filter(move |figure| figure.0 == *name))
        .map(|figure| &figure.1)
        .collect();
    let svg = msdd_draw::sheet(&figures, COLUMNS);
    if let Some(file) = &arguments.svg {
        msdd_files::write(file, svg.as_bytes())?;
        outln!("{}", file.display());
    }
    if let Some(file) = &arguments.png {
        msdd_files::write(file, &picture::png(&svg)?)?;
        outln!("{}", file.display());
    }
    Ok(())
}
