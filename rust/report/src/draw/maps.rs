//! Draws maps of sub-regions with the values written into them.

use super::{Drawn, FONT, SIZE, responsive};
use crate::ReportError;
use plotters::prelude::*;

/// Draws maps of 10 x 3 sub-regions, one below the other with the same colour scale, each value written into its sub-region.
///
/// # Errors
/// [`ReportError::Draw`].
pub fn maps(title: &str, digits: usize, named: &[(&str, Vec<f64>)]) -> Result<String, ReportError> {
    let mut svg = String::new();
    draw_maps(&mut svg, title, digits, named)
        .map_err(|error| ReportError::Draw { figure: title.to_string(), problem: error.to_string() })?;
    Ok(responsive(&svg, title))
}

fn draw_maps(svg: &mut String, title: &str, digits: usize, named: &[(&str, Vec<f64>)]) -> Drawn {
    const CELL: (i32, i32) = (46, 27);
    const ROW: i32 = 3 * CELL.1 + 26;
    let height = 30 + ROW * named.len() as i32;
    let root = SVGBackend::with_string(svg, (SIZE.0, height as u32)).into_drawing_area();
    root.fill(&WHITE)?;
    root.draw(&Text::new(title.to_string(), (10, 6), (FONT, 16)))?;
    let all = || named.iter().flat_map(|(_, values)| values.iter().copied());
    let (low, high) = (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
    for (row, (name, values)) in named.iter().enumerate() {
        let top = 30 + ROW * row as i32;
        root.draw(&Text::new((*name).to_string(), (10, top + 3), (FONT, 13)))?;
        for (k, value) in values.iter().enumerate() {
            // From the lower left, x index fastest
            let (i, j) = ((k % 10) as i32, (k / 10) as i32);
            let corner = (10 + i * CELL.0, top + 20 + (2 - j) * CELL.1);
            let colour = shade((value - low) / (high - low).max(1e-300));
            let opposite = (corner.0 + CELL.0, corner.1 + CELL.1);
            root.draw(&Rectangle::new([corner, opposite], colour.filled()))?;
            let ink =
                if 0.3 * f64::from(colour.0) + 0.6 * f64::from(colour.1) > 110.0 { BLACK } else { WHITE };
            // Not -0.00
            let size = 10f64.powi(digits as i32);
            let text = format!("{:.digits$}", (size * value).round() / size + 0.0);
            let place = (corner.0 + 4, corner.1 + 7);
            root.draw(&Text::new(text, place, (FONT, 13).into_font().color(&ink)))?;
        }
    }
    root.present()?;
    Ok(())
}

/// Colour from dark (0) to light (1), by five colours of the palette viridis; also in grey, darker means less.
pub(super) fn shade(share: f64) -> RGBColor {
    const STOPS: [[f64; 3]; 5] = [
        [68.0, 1.0, 84.0],
        [59.0, 82.0, 139.0],
        [33.0, 145.0, 140.0],
        [94.0, 201.0, 98.0],
        [253.0, 231.0, 37.0],
    ];
    let place = 4.0 * share.clamp(0.0, 1.0);
    let k = (place as usize).min(3);
    let part = place - k as f64;
    let [r, g, b] = [0, 1, 2].map(|c| (STOPS[k][c] + part * (STOPS[k + 1][c] - STOPS[k][c])) as u8);
    RGBColor(r, g, b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_write_every_value() {
        let values: Vec<f64> = (0..30).map(|k| 0.1 + 0.001 * f64::from(k)).collect();
        let svg = maps("porosity [-]", 3, &[("solver", values)]).unwrap();
        assert!(svg.contains("0.100") && svg.contains("0.129"));
        assert!(!maps("", 2, &[("", vec![-1e-4; 30])]).unwrap().contains("-0.00"));
    }

    #[test]
    fn shades_grow_lighter() {
        let light = |share: f64| {
            let RGBColor(r, g, b) = shade(share);
            0.3 * f64::from(r) + 0.59 * f64::from(g) + 0.11 * f64::from(b)
        };
        assert!((0..10).all(|k| light(f64::from(k + 1) / 10.0) > light(f64::from(k) / 10.0) + 5.0));
    }
}
