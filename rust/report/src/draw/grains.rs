//! Draws the grains in a window, to scale, in colours by a value.

use super::maps::shade;
use super::{Drawn, FONT, SIZE, responsive};
use crate::ReportError;
use plotters::prelude::*;

/// A grain: centre and radius \[m\], and the value that determines its colour.
#[derive(Clone, Copy, Debug)]
pub struct Grain {
    pub at: [f64; 2],
    pub radius: f64,
    pub value: f64,
}

/// Left and upper edge, and side of the window in the figure [px].
const WINDOW: (i32, i32, i32) = (30, 34, 420);
/// Height of the scale below the window [px].
const SCALE: i32 = 46;

/// Draws the grains in the square from `low` to `high` \[m\], from dark for the value 0 to light for `most`, with the colour
/// scale and `label` below.
///
/// # Errors
/// [`ReportError::Draw`].
pub fn grains(
    title: &str,
    [low, high]: [[f64; 2]; 2],
    list: &[Grain],
    (most, label): (f64, &str),
) -> Result<String, ReportError> {
    let mut svg = String::new();
    draw(&mut svg, title, low, high[0] - low[0], list, most, label)
        .map_err(|error| ReportError::Draw { figure: title.to_string(), problem: error.to_string() })?;
    Ok(responsive(&svg, title))
}

fn draw(
    svg: &mut String,
    title: &str,
    low: [f64; 2],
    side: f64,
    list: &[Grain],
    most: f64,
    label: &str,
) -> Drawn {
    let (left, top, size) = WINDOW;
    let height = top + size + SCALE + 4;
    let root = SVGBackend::with_string(svg, (SIZE.0, height as u32)).into_drawing_area();
    root.fill(&WHITE)?;
    let pixels = f64::from(size) / side;
    for grain in list {
        let x = left + (pixels * (grain.at[0] - low[0])).round() as i32;
        let y = top + size - (pixels * (grain.at[1] - low[1])).round() as i32;
        let radius = (pixels * grain.radius).round() as i32;
        root.draw(&Circle::new((x, y), radius, shade(grain.value / most.max(1e-300)).filled()))?;
        root.draw(&Circle::new((x, y), radius, BLACK.stroke_width(1)))?;
    }
    // The parts of grains outside of the window are covered by white rectangles.
    let (right, bottom) = (left + size, top + size);
    // The rectangles reach beyond the figure, because grains do, too
    let (width, end) = (SIZE.0 as i32 + size, height + size);
    for cover in [
        [(0, 0), (left, end)],
        [(right, 0), (width, end)],
        [(0, 0), (width, top)],
        [(0, bottom), (width, end)],
    ] {
        root.draw(&Rectangle::new(cover, WHITE.filled()))?;
    }
    root.draw(&Rectangle::new([(left, top), (right, bottom)], BLACK.stroke_width(1)))?;
    root.draw(&Text::new(title.to_string(), (left, 8), (FONT, 16)))?;
    scale(&root, (left, bottom + 8), most, label)?;
    root.present()?;
    Ok(())
}

fn scale(
    root: &DrawingArea<SVGBackend, plotters::coord::Shift>,
    (x, y): (i32, i32),
    most: f64,
    label: &str,
) -> Drawn {
    const STEPS: i32 = 20;
    const STEP: i32 = 9;
    for k in 0..STEPS {
        let corners = [(x + k * STEP, y), (x + (k + 1) * STEP, y + 12)];
        root.draw(&Rectangle::new(corners, shade((f64::from(k) + 0.5) / f64::from(STEPS)).filled()))?;
    }
    root.draw(&Text::new("0", (x, y + 16), (FONT, 13)))?;
    let value = if most >= 10.0 { format!("{most:.0}") } else { format!("{most:.1}") };
    root.draw(&Text::new(value, (x + STEPS * STEP - 18, y + 16), (FONT, 13)))?;
    root.draw(&Text::new(label.to_string(), (x + STEPS * STEP + 10, y - 1), (FONT, 13)))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grain_is_drawn_to_scale() {
        let grain = Grain { at: [0.06, 0.03], radius: 0.012, value: 2.0 };
        let svg = grains("case H", [[0.0; 2], [0.12; 2]], &[grain], (4.0, "overlap [%]")).unwrap();
        // 420 px are 0.12 m
        assert!(svg.contains("cx=\"240\" cy=\"349\" r=\"42\""), "{svg}");
        assert!(svg.contains("overlap [%]") && svg.contains("4.0"));
    }
}
