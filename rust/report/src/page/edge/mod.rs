//! Section of the page with the failure map.

mod drift;
mod elements;
mod solver;

use crate::ReportError;
use crate::report::Made;
use msdd_draw::html::table;

pub fn section(made: &Made) -> Result<String, ReportError> {
    let mut html = "<h2>Where methods break</h2>\n<p>The configuration of each row was run. <b>refused</b>: nothing was computed; <b>ended</b>: the run stopped with the \
                    message; <b>cut</b>: steps were repeated with half the size; <b>reported</b>: the run went on, and its summary or log says so; \
                    <b>done</b>: nothing to report.</p>\n"
        .to_string();
    let rows = &made.report.failures.rows;
    let cells = rows.iter().map(|r| {
        let behaviour =
            if r.as_allowed { r.behaviour.clone() } else { format!("{}, NOT as it should be", r.behaviour) };
        [r.method.clone(), r.condition.clone(), r.predicted.clone(), behaviour, r.message.clone()].to_vec()
    });
    let wrong = rows.iter().filter(|r| !r.as_allowed).count();
    html += &format!("<p>{} of {} rows behave as they should.</p>\n", rows.len() - wrong, rows.len());
    html += &table(
        &["'method", "'condition", "'predicted", "'behaviour", "\"what came out"],
        &cells.collect::<Vec<_>>(),
    );
    html += &elements::steps(made)?;
    html += &elements::slowness(made)?;
    html += &elements::unjamming(made)?;
    html += &solver::coupling(made)?;
    html += &solver::discretisation(made)?;
    html += &solver::cycles(made)?;
    html += &drift::drift(made)?;
    Ok(html)
}
