//! The page: one HTML file with its figures inside, without scripts.

mod beyond;
pub mod case;
mod chart;
mod curves;
mod edge;
mod fields;
mod html;
mod requests;
pub mod spheres;
mod states;
mod validation;

use crate::ReportError;
use crate::report::Made;
use msdd_draw::escape;
use msdd_draw::html::{head, numbered};
use std::fmt::Write;

/// The page's text.
///
/// # Errors
/// [`ReportError::Draw`].
pub fn text(made: &Made) -> Result<String, ReportError> {
    let report = &made.report;
    let stamp = &report.made;
    let mut page = head("MSDD: speed against accuracy");
    let _ = writeln!(
        page,
        "<h1>Speed against accuracy</h1>\n<p>Heat conduction with thermal expansion in a bed of 15 000 grains: the solver against \
         DEM of the same packings. {} jobs, {} of them from the cache; made {} on {}, commit {}.{}</p>",
        report.jobs,
        report.cached_jobs,
        escape(&stamp.date),
        escape(&stamp.cpu),
        escape(&stamp.commit),
        if report.quick {
            " <b>Quick version: few configurations, coarse meshes, one packing.</b>"
        } else {
            ""
        }
    );
    page += "<p class=\"source\">How values are known. <b>committed</b>: the reference by DEM, three packings, \
             <code>cases/reference/make</code>, commit as above. <b>measured</b>: by this run of the report. <b>cached</b>: measured by an earlier one \
             with the same programs, parameters and processor. <b>extrapolated</b>: from a shorter run. <b>quoted</b>: from the paper. \
             Nothing is fitted to these runs: conductivity, stress, mechanical tangent and wall friction come from the database of \
             small boxes. Cost is processor time of one process, start and output included. Beds of spheres have a page of their own, spheres.html beside this one.</p>\n";
    page += &chart::section(made)?;
    page += &requests::section(made)?;
    page += &validation::section(made)?;
    page += &edge::section(made)?;
    let _ = write!(page, "<h2>Left out</h2>\n<ul>\n");
    for text in &report.left_out {
        let _ = writeln!(page, "<li>{}</li>", escape(text));
    }
    Ok(numbered(&(page + "</ul>\n</body>\n</html>\n")))
}
