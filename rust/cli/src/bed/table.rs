//! What `msdd bed run` prints.

use super::results::Results;
use msdd_beds::exchange::Exchange;
use msdd_beds::experiment::{Misfit, left_out};

/// Prints the packing, its conductivity, the differences from the measurements, and what is to be warned of.
pub fn print(results: &Results) {
    packing(results);
    differences(results);
    for warning in warnings(results) {
        outln!("Note: {warning}");
    }
}

fn packing(results: &Results) {
    let bed = &results.bed;
    outln!(
        "{} grains, seed {}; they press on the plate with {:.1} Pa",
        bed.simulation.spheres.len(),
        results.case.seed,
        bed.plate_force() / bed.area(&results.case)
    );
    if results.case.grains.sizes.is_some() {
        outln!("{}", results.case.grains.moments());
    }
    let radiates = bed.exchange.is_some();
    let more = if radiates { " + radiation" } else { "" };
    outln!("mm from the plate   porosity   contacts   p [Pa]   k [W/(m K)] = contacts + gas{more}");
    for ([from, to], slab) in &results.slabs {
        let (contacts, gas) = (slab.contact_conductivity, slab.gas_conductivity);
        let radiation = slab.radiation_conductivity;
        let more = if radiates { format!(" + {radiation:.3}") } else { String::new() };
        outln!(
            "{:>6.0} to {:<6.0}      {:<8.3}   {:<8.2}   {:<6.0}   {:.3} = {contacts:.3} + {gas:.3}{more}",
            1e3 * from,
            1e3 * to,
            1.0 - slab.solid_fraction,
            slab.coordination,
            slab.pressure,
            contacts + gas + radiation
        );
    }
}

fn differences(results: &Results) {
    if results.measured.is_empty() {
        return;
    }
    outln!("simulated less measured [K]");
    outln!("plate       mm from it   points     rms   worst    mean");
    for run in &results.compared {
        for misfit in &run.misfits {
            let place = misfit.distance.map_or("all".to_string(), |d| format!("{:.0}", 1e3 * d));
            outln!("{:<12}{place:>10}   {}", run.heated.kind, numbers(misfit));
        }
    }
    if results.varied.is_empty() {
        return;
    }
    outln!("with one value changed, all distances [K]");
    for varied in &results.varied {
        let what = format!("{} = {}", varied.key, varied.value);
        outln!("{:<12}{what:<36} {}", varied.kind, numbers(&varied.misfit));
    }
}

fn numbers(misfit: &Misfit) -> String {
    let cell = |x: f64| if x.is_finite() { format!("{x:.2}") } else { "–".to_string() };
    let [rms, worst, bias] = [misfit.rms, misfit.worst, misfit.bias].map(cell);
    format!("{:>6}  {rms:>6}  {worst:>6}  {bias:>6}", misfit.points)
}

/// Measurements that are not compared, contacts that yield, what a lid that stopped presses with, a closure instead of the law of pairs.
pub fn warnings(results: &Results) -> Vec<String> {
    let missing = results.compared.first().map(|run| left_out(&results.measured, &run.heated.records));
    let missing = missing.filter(|count| *count > 0).map(|count| {
        let all = results.measured.len();
        format!("{count} of {all} measurements lie outside the time of the run and are left out")
    });
    let stress = results.case.grains.peak_stress(&results.bed.simulation).and_then(|stress| stress.warning());
    let lid = results.bed.lid_pressure(&results.case).map(|pressure| {
        format!(
            "the lid, which stopped at a porosity, presses with {pressure:.3e} Pa; that is in proportion to grains.simulated_young_modulus"
        )
    });
    let noise = results.bed.exchange.as_ref().and_then(Exchange::warning);
    let of_grains = results.case.closure().into_iter().chain(results.case.varying_emissivity());
    missing.into_iter().chain(stress).chain(lid).chain(of_grains).chain(noise).collect()
}
