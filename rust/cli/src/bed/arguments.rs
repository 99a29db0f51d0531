//! Arguments of `msdd bed run`.

use clap::Args;
use std::path::PathBuf;

#[derive(Args)]
#[command(after_help = "Examples:
  msdd bed run cases/beaulieu
  msdd bed run cases/beaulieu --vary     what the uncertain inputs change, one at a time
  msdd bed run cases/store --packings 2  the mean of two packings, and how much they differ

The folder holds bed.toml (keys: the book, Reference, Description of a bed) and, if there is an experiment, its
measurements. Of a bed without a plate, whose walls move while heat flows, the only result is dem.csv; with
--packings it is the mean, dem-scatter.csv is the standard deviation of one packing, and dem-<seed>.csv are the single
ones: what is there already, from the same bed.toml, is not computed again. Into the folder of results of a bed with a plate go
  temperature.csv   T over time at the probes, without and with contact resistance at the plate
  comparison.csv    differences from the measurements
  bed.json          the packing, heat and its balance, and how each stage came to rest
  grains.vtp        the grains with their temperatures at the end, for ParaView
  temperature.svg   a plot of temperatures and measurements

The plate is taken in two ways: 'held', the first layer of grains has its temperature, the most that any plate can do; and
'resisting', heat passes through contacts and gas between plate and grains.")]
pub struct RunArguments {
    /// Folder with bed.toml.
    pub case: PathBuf,
    /// Folder for the results. Default: results/beds/ and the name of the case.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Seed of the packing. Default: from the case.
    #[arg(long, value_parser = clap::value_parser!(u64).range(..=i64::MAX as u64))]
    pub seed: Option<u64>,
    /// Packings with this many seeds, from the case's seed on; of a bed without a plate. Default: one packing.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=1000))]
    pub packings: Option<u32>,
    /// Compute it again with each value of the blocks [[vary]] of the case, one changed at a time.
    #[arg(long)]
    pub vary: bool,
    /// Begin a run of more than an hour without asking; of a bed without a plate.
    #[arg(long)]
    pub yes: bool,
    /// Number of threads; the results do not depend on it.
    #[arg(long, default_value_t = 2, value_parser = crate::threads::parser())]
    pub threads: u32,
}
