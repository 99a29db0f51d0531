//! Prints the targets of accuracy without the rest of the report: runs the solver in H, C, HC, corner, material and cycle.
//!
//!     cargo run --release -p msdd-report --example targets [-- NAME]      # only cases whose name contains NAME

use msdd_dem_reference::packings::Reference;
use msdd_report::failures::cycles;
use msdd_report::jobs::cache::{Cache, programs};
use msdd_report::jobs::execute::{Place, Stamp};
use msdd_report::jobs::pool::{self, Asked};
use msdd_report::plan::{self, CHARTED};
use msdd_report::settings::Settings;
use msdd_report::studies::{other_cases, targets, validation};
use std::collections::BTreeMap;

fn main() {
    let checkout = std::env::current_dir().expect("a folder");
    let cache = checkout.join(".cache/targets");
    let stamp = Stamp { date: String::new(), commit: String::new(), cpu: "any".to_string() };
    let programs = programs(&checkout).expect("scripts/foam-env");
    let settings = Settings {
        quick: false,
        place: Place {
            checkout: checkout.clone(),
            msdd: checkout.join("target/release/msdd"),
            work: cache.join("work"),
            stamp,
            lock: None,
        },
        cache: Cache::new(&cache, &checkout, "any", &programs),
        at_a_time: 2,
        run: true,
    };
    let mut jobs = Vec::new();
    for configuration in plan::validated(false).iter().take(2) {
        for case in CHARTED {
            jobs.extend(settings.seeds().iter().map(|seed| configuration.asked(case, *seed)));
        }
    }
    jobs.extend(other_cases::jobs());
    jobs.extend(cycles::jobs().into_iter().map(|job| Asked { job, guess: 10.0 }));
    let records = pool::run(&settings.cache, &settings.place, &jobs, 2, &mut |_| ()).expect("runs");
    let references: Vec<Reference> = CHARTED
        .iter()
        .map(|case| Reference::read(&checkout, case, settings.seeds()).expect("reference"))
        .collect();
    let mut kept = BTreeMap::new();
    let found = validation::validation(&settings, &records, &references, &mut kept);
    for one in found.iter().filter(|v| v.errors.is_some()) {
        let errors = one.errors.as_ref().expect("filtered");
        println!(
            "{} {}: T {:.2?} p {:.2} inner {:.2?} displacement {:.1?}",
            one.case,
            one.configuration,
            errors.temperature,
            errors.pressure,
            errors.pressure_inner,
            errors.displacement
        );
        for f in &errors.fields {
            println!("   {} rms {:.4} inner {:.4} means {:.4?}", f.quantity, f.rms, f.rms_inner, f.means);
        }
    }
    for target in targets::targets(&found, false) {
        println!(
            "{:3} {:50} {:6.2} {:6.2?} {}",
            target.case, target.what, target.target, target.reached, target.beside
        );
    }
    let others = other_cases::read(&settings, &records, &references).expect("others");
    for row in others.rows {
        println!(
            "{} {}: T {:.2?} p {:.2?} {}",
            row.case, row.what, row.temperature, row.pressure, row.outcome
        );
    }
    for c in cycles::read(&settings, &records) {
        println!("{c:?}");
    }
    for record in records.values().filter(|r| r.run.is_none()) {
        println!("{:?} {}", record.outcome, record.message);
    }
}
