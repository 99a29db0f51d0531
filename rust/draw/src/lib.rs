//! Charts and maps as SVG, small enough to be read on a phone, and the parts of pages that show them. Nothing here is specific to
//! a program or a case.
//!
//! | module | what |
//! |---|---|
//! | [`text`] | numbers as people write them, and text that is safe in HTML and SVG |
//! | [`chart`] | lines and markers on axes |
//! | [`map`] | cells or grains in colours by a value, with the colour scale |
//! | [`sheet`] | several figures as one picture |
//! | [`page`](mod@page) | pages from templates, whose text describes charts and tables |
//! | [`html`] | head, tables and figures of a page that needs no other files |
#![forbid(unsafe_code)]

pub mod chart;
pub mod html;
pub mod map;
pub mod page;
pub mod sheet;
pub mod text;

pub use chart::{Axis, Line, MARKERS, Marker, Series, Style, from_data, key, plot, plot_named, series};
pub use map::{Cells, Map, Sheet, maps};
pub use page::page;
pub use sheet::sheet;
pub use text::{escape, number};

/// A figure that cannot be drawn.
#[derive(Debug, thiserror::Error)]
#[error("cannot draw {figure}: {problem}")]
pub struct DrawError {
    pub figure: String,
    pub problem: String,
}
