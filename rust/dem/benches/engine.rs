//! Cost of the engine's parts: `cargo bench -p msdd-dem [-- FILTER]`. Throughput is in contacts or discs per second.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use msdd_dem::{Disc, Material, Simd, Simulation, Stage, Thermal, WallHeat, Walls};
use std::time::{Duration, Instant};

/// An assembly as small as an RVE, and one that is divided into several slabs.
const SIZES: [usize; 2] = [500, 15_000];
/// Steps after which a run starts again from the dense state; at 0.1 1/s they are at most 2 % strain.
const BLOCK: u64 = 500;

/// About `count` discs of unequal size on a jittered lattice, squeezed until they have four to five contacts each, and
/// growing at 0.1 1/s.
fn dense(count: usize) -> Simulation {
    let material = Material::default();
    let side = (count as f64).sqrt().ceil() as usize;
    let spacing = 9.7e-3;
    let discs = (0..count)
        .map(|k| {
            let u = |a: f64| (a * (k + 1) as f64).fract();
            let (column, line) = ((k % side) as f64, (k / side) as f64);
            let (x, y) = (column + 0.5 + 0.1 * u(0.618_034), line + 0.5 + 0.1 * u(0.732_051));
            Disc::at_rest(spacing * x, spacing * y, 4e-3 + 2e-3 * u(0.414_214), material.density)
        })
        .collect();
    let lines = count.div_ceil(side) as f64;
    let walls = Walls::around(spacing * (side as f64 + 0.1), spacing * (lines + 0.1));
    let mut simulation = Simulation::new(material, discs, walls);
    simulation.free_drag = 20.0;
    simulation.take_steps(1000);
    simulation.reset_strain();
    simulation.set_strain_rate(0.1);
    simulation
}

fn available() -> impl Iterator<Item = Simd> {
    Simd::ALL.into_iter().filter(|simd| simd.available())
}

fn contacts(simulation: &Simulation) -> u64 {
    let mut count = 0;
    simulation.for_each_contact(|contact| count += u64::from(contact.i.is_ok()));
    count
}

/// Time of `steps` steps from `start`, or of their stage `stage` alone.
fn time_of(start: &Simulation, steps: u64, stage: Option<Stage>) -> Duration {
    let (mut total, mut done) = (Duration::ZERO, 0);
    while done < steps {
        let mut simulation = start.clone();
        let block = BLOCK.min(steps - done);
        match stage {
            None => {
                let begin = Instant::now();
                simulation.take_steps(block);
                total += begin.elapsed();
            }
            Some(stage) => {
                total += (0..block).map(|_| time_in_stage(&mut simulation, stage)).sum::<Duration>()
            }
        }
        done += block;
    }
    total
}

fn time_in_stage(simulation: &mut Simulation, stage: Stage) -> Duration {
    let (mut last, mut found) = (Instant::now(), Duration::ZERO);
    simulation.step_marked(|ended| {
        let now = Instant::now();
        if ended == stage {
            found = now - last;
        }
        last = now;
    });
    found
}

/// Pair forces alone, by instruction set; only force-bearing contacts count in the throughput.
fn pair_kernel(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("pair forces, per contact");
    let mut start = dense(SIZES[0]);
    group.throughput(Throughput::Elements(contacts(&start)));
    for simd in available() {
        start.set_simd(simd);
        group.bench_function(BenchmarkId::from_parameter(format!("{simd:?}")), |bencher| {
            bencher.iter_custom(|steps| time_of(&start, steps, Some(Stage::Pairs)));
        });
    }
}

fn motion_kernel(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("motion, per disc");
    let mut start = dense(SIZES[0]);
    group.throughput(Throughput::Elements(start.discs.len() as u64));
    for simd in available() {
        start.set_simd(simd);
        group.bench_function(BenchmarkId::from_parameter(format!("{simd:?}")), |bencher| {
            bencher.iter_custom(|steps| time_of(&start, steps, Some(Stage::Motion)));
        });
    }
}

/// Whole steps on one thread, including rebuilds of the neighbour list.
fn step(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("step, per disc");
    for size in SIZES {
        let start = dense(size);
        group.throughput(Throughput::Elements(size as u64));
        group.bench_function(BenchmarkId::from_parameter(size), |bencher| {
            bencher.iter_custom(|steps| time_of(&start, steps, None));
        });
    }
}

fn neighbours(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("neighbour search, per disc");
    for size in SIZES {
        let mut simulation = dense(size);
        group.throughput(Throughput::Elements(size as u64));
        group.bench_function(BenchmarkId::from_parameter(size), |bencher| {
            bencher.iter(|| simulation.rebuild_neighbours());
        });
    }
}

/// One heat sub-step through existing pipes, with the left wall hot.
fn heat(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("heat sub-step, per contact");
    for size in SIZES {
        let mut simulation = dense(size);
        let mut walls = [WallHeat::Insulated; 4];
        walls[0] = WallHeat::Temperature(100.0);
        simulation.enable_heat(Thermal { expansion: 0.0, ..Thermal::default() }, walls);
        simulation.conduct(1e-6);
        group.throughput(Throughput::Elements(contacts(&simulation)));
        group.bench_function(BenchmarkId::from_parameter(size), |bencher| {
            bencher.iter(|| simulation.conduct_once(1e-6));
        });
    }
}

criterion_group!(engine, pair_kernel, motion_kernel, step, neighbours, heat);
criterion_main!(engine);
