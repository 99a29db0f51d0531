//! The Pareto front in the chart of error against cost.

use serde::Serialize;

/// One configuration of the chart of one case.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Point {
    pub name: String,
    /// Kind of the configuration, which determines its marker: one of [`crate::plan::FAMILIES`].
    pub family: String,
    /// Processor time, with the start of the program \[s\].
    pub core_seconds: Option<f64>,
    /// Error of T at the worst probe [% of the range], and of the pressure [% of the paper's range]; `None` for runs that were
    /// not completed.
    pub temperature_error: Option<f64>,
    pub pressure_error: Option<f64>,
    /// How the cost is known: "measured", "cached", "extrapolated", "quoted".
    pub cost: String,
    pub outcome: String,
    pub message: String,
    /// Whether the point is on the Pareto front of T, and of the pressure: no other point is both cheaper and more accurate.
    /// Quoted and extrapolated points are not considered.
    pub front: [bool; 2],
}

impl Point {
    fn takes_part(&self) -> bool {
        self.cost == "measured" || self.cost == "cached"
    }

    /// Cost and error of T (0) or of the pressure (1).
    pub fn place(&self, which: usize) -> Option<(f64, f64)> {
        let error = if which == 0 { self.temperature_error } else { self.pressure_error };
        Some((self.core_seconds?, error?))
    }
}

/// Marks the points on the Pareto fronts.
pub fn mark(points: &mut [Point]) {
    for which in [0, 1] {
        let places: Vec<Option<(f64, f64)>> =
            points.iter().map(|p| p.takes_part().then(|| p.place(which)).flatten()).collect();
        for (k, point) in points.iter_mut().enumerate() {
            point.front[which] = places[k].is_some_and(|(cost, error)| {
                !places.iter().flatten().any(|&(c, e)| c <= cost && e <= error && (c < cost || e < error))
            });
        }
    }
}

/// Corners of the line of the front of T (0) or of the pressure (1), by rising cost.
pub fn stairs(points: &[Point], which: usize) -> Vec<(f64, f64)> {
    let mut places: Vec<(f64, f64)> =
        points.iter().filter(|p| p.front[which]).filter_map(|p| p.place(which)).collect();
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    // The line is a staircase: for a cost between those of two points, the cheaper point is the best that can be had.
    let mut stairs = Vec::new();
    for place in places {
        if let Some(&(_, last)) = stairs.last() {
            stairs.push((place.0, last));
        }
        stairs.push(place);
    }
    stairs
}

/// The cheapest configuration with an error of T of at most `error` [%].
pub fn cheapest(points: &[Point], error: f64) -> Option<&Point> {
    let good = points.iter().filter(|p| p.takes_part());
    good.filter(|p| p.place(0).is_some_and(|(_, e)| e <= error)).min_by(|a, b| {
        a.core_seconds.unwrap_or(f64::INFINITY).total_cmp(&b.core_seconds.unwrap_or(f64::INFINITY))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(name: &str, core_seconds: f64, error: f64, cost: &str) -> Point {
        Point {
            name: name.to_string(),
            family: String::new(),
            core_seconds: Some(core_seconds),
            temperature_error: Some(error),
            pressure_error: None,
            cost: cost.to_string(),
            outcome: "done".to_string(),
            message: String::new(),
            front: [false; 2],
        }
    }

    #[test]
    fn dominated_points_are_not_on_the_front() {
        let mut points = vec![
            point("cheap", 1.0, 5.0, "measured"),
            point("worse", 2.0, 6.0, "measured"),
            point("good", 3.0, 1.0, "cached"),
            point("guess", 0.5, 0.1, "extrapolated"),
        ];
        mark(&mut points);
        let front: Vec<bool> = points.iter().map(|p| p.front[0]).collect();
        assert_eq!(front, [true, false, true, false]);
        assert!(points.iter().all(|p| !p.front[1]));
        assert_eq!(cheapest(&points, 2.0).unwrap().name, "good");
        assert_eq!(cheapest(&points, 5.0).unwrap().name, "cheap");
        assert!(cheapest(&points, 0.5).is_none());
    }
}
