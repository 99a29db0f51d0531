//! Section of the page on runs that are asked for an accuracy: requested against true error, and the error bands.

use super::html::Figure;
use crate::ReportError;
use crate::report::Made;
use crate::studies::requests::{Band, Request, tallies};
use msdd_draw::html::{fixed, table};
use msdd_draw::{Axis, Line, MARKERS, Series, Style, plot};

/// Kinds of scenes, and what they are for.
const USES: [(&str, &str); 3] = [
    ("calibrate", "scenes that the bands are fitted to"),
    ("judge", "scenes that judge them"),
    ("outside", "outside of what the model was trained for"),
];

pub fn section(made: &Made) -> Result<String, ReportError> {
    let mut html = "<h2>Accuracy in, the cheapest run out</h2>\n<p><code>msdd case solve</code> is asked for 5, 2 and 1 % of the range of T in 32 scenes of 380 to \
                    2 000 grains that differ in shape, walls, heating, packing and expansion. The error is the root of the mean square over bed and run, against the discrete \
                    elements of the same packing. A request is refused where the model and the scatter of packings leave more open. What could have been done is known \
                    afterwards: some run was within the request.</p>\n"
        .to_string();
    html += &requests_table(&made.judged.requests);
    html += &figure(made)?;
    html += "<p>The run comes with 90 % bands. Values of DEM in windows of some 100 grains that lie inside, in the worst scene in brackets, \
             and the width of the bands over twice the standard deviation between packings (median over the scenes):</p>\n";
    html += &bands_table(&made.judged.bands);
    Ok(html)
}

fn requests_table(requests: &[Request]) -> String {
    let tallies = tallies(requests);
    let mut rows = Vec::new();
    for (purpose, name) in USES {
        for tally in tallies.iter().filter(|tally| tally.purpose == purpose) {
            rows.push(vec![
                name.to_string(),
                format!("{} %", tally.asked),
                format!("{} of {}", tally.met, tally.kept),
                tally.refused.to_string(),
                tally.possible.to_string(),
                fixed(tally.cost, 1),
                fixed(tally.highest_cost, 1),
            ]);
        }
    }
    let heads = [
        "'scenes",
        "asked",
        "within the request",
        "refused",
        "of which could have been done",
        "cost over the cheapest that would have done, median",
        "worst",
    ];
    table(&heads, &rows)
}

fn figure(made: &Made) -> Result<String, ReportError> {
    let axis = |label| Axis { label, log: true, range: Some((0.1, 10.0)) };
    let mut series = vec![Series {
        points: vec![(0.1, 0.1), (10.0, 10.0)],
        bars: Vec::new(),
        style: Style::line(4, Line::Solid),
    }];
    let mut keys = vec![(Style::line(4, Line::Solid), "as asked".to_string())];
    for (k, (purpose, name)) in USES.into_iter().enumerate() {
        let style = Style::marker(k + 1, MARKERS[k]);
        let own = made.judged.requests.iter().filter(|r| r.purpose == purpose && r.offered.is_none());
        // Beside each other, so that all can be seen.
        let shift = 1.0 + 0.07 * (k as f64 - 1.0);
        let points = own.map(|request| (request.asked * shift, request.error)).collect();
        series.push(Series { points, bars: Vec::new(), style });
        keys.push((style, name.to_string()));
    }
    let (x, y) = (axis("error of T asked for [%]"), axis("true error of T [%]"));
    let panels = vec![plot("requests that were not refused", &x, &y, &series)?];
    let caption = "Fig. #. Requested against true error of T, one point a run, both axes logarithmic, in % of the range. Below the line the run is as accurate as it was asked to be. \
                   The three kinds of scenes are drawn beside each other."
        .to_string();
    Figure { id: "requests", panels, keys, caption, source: "committed, cases/scenes/requests.csv" }
        .html(&made.report.made)
}

fn bands_table(bands: &[Band]) -> String {
    let mut rows: Vec<Vec<String>> = Vec::new();
    for band in bands {
        let cells = [
            format!("{:.1} % ({:.0} %)", 100.0 * band.inside, 100.0 * band.worst),
            fixed(Some(band.width), 1),
        ];
        match rows.iter_mut().find(|row| row[0] == band.quantity) {
            Some(row) => row.extend(cells),
            None => rows.push([vec![band.quantity.clone()], cells.to_vec()].concat()),
        }
    }
    let heads =
        ["'quantity", "fitted to: inside", "width", "judged: inside", "width", "outside: inside", "width"];
    table(&heads, &rows)
}
