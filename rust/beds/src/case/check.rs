//! What a description of a bed may be, for DEM.

use super::grains::{
    EXPANSIONS, POISSON_RATIOS, POSITIVE, REFERENCE_FRACTION, Ranged, TEMPERATURES, emissivity, hardness,
    ranged, rough, temperature,
};
use super::sections::{INTERVAL, MIN_HEIGHT, MIN_SPHERES, OUTPUT_EVERY, POROSITIES, SOURCES, STEPS, STRAINS};
use super::{BedCase, Lid, PlateKeys, Shell, Sides, Wrong};
use crate::schedule::Schedule;
use msdd_engine::message::number;
use std::f64::consts::PI;

/// What `time.output_every` may be next to a plate.
const PLATE_OUTPUT: &str = "a hundred-thousandth of end, to end";

fn wrong<T>(key: &str, value: impl Into<String>, allowed: impl Into<String>) -> Result<T, Wrong> {
    Err((key.to_string(), value.into(), allowed.into()))
}

fn check(key: &str, schedule: &Schedule, values: [f64; 2]) -> Result<(), Wrong> {
    schedule.check(values).map_err(|(value, allowed)| (key.to_string(), value, allowed))
}

impl BedCase {
    pub(super) fn check(&self) -> Result<(), Wrong> {
        self.grains.check_sizes()?;
        let mut numbers = self.grains.numbers();
        numbers.extend(self.container.numbers(&self.grains));
        numbers.extend(self.gas.numbers());
        numbers.extend(self.numbers());
        match &self.plate {
            Some(plate) => numbers.extend(self.numbers_of(plate)),
            None => numbers.extend(self.numbers_of_moving()),
        }
        if let Some((key, value, allowed, _)) = numbers.into_iter().find(|number| !number.3) {
            return wrong(key, number(value), allowed);
        }
        self.container.check(&self.grains)?;
        match &self.plate {
            Some(plate) => self.check_plate(plate),
            None => self.check_moving(),
        }
    }

    /// What only the solver computes.
    fn check_solver(&self) -> Result<(), Wrong> {
        if self.flow.is_some() {
            return wrong(
                "flow",
                "given",
                "none by DEM, whose gas is at rest; 'msdd case new --from' computes it",
            );
        }
        for heated in &self.heated {
            let others =
                [("coefficient", heated.coefficient), ("outside", heated.outside), ("flux", heated.flux)];
            if let Some((key, _)) = others.into_iter().find(|(_, value)| value.is_some()) {
                return wrong(&format!("heated.{key}"), "given", "a temperature of the wall by DEM");
            }
            if heated.temperature.is_none() {
                return wrong("heated.temperature", "not given", "a temperature of the wall");
            }
        }
        Ok(())
    }

    fn check_walls<'a>(
        &self,
        named: impl Iterator<Item = (&'a str, &'a String)>,
        flat: bool,
    ) -> Result<(), Wrong> {
        let names: Vec<&str> =
            self.wall_names().into_iter().filter(|name| !flat || *name != "side").collect();
        for (key, name) in named {
            if !names.contains(&name.as_str()) {
                return wrong(key, name, names.join(", "));
            }
        }
        Ok(())
    }

    /// A bed with a plate, whose spheres keep their places.
    fn check_plate(&self, plate: &PlateKeys) -> Result<(), Wrong> {
        hardness("plate.hardness", plate.roughness, plate.hardness)?;
        let (strain, pressing) = self.lid_moves();
        let moving = [
            ("container.endless", self.container.endless),
            ("grains.thermal_expansion", self.grains.thermal_expansion.is_some()),
            ("heated", !self.heated.is_empty()),
            ("heat_source", self.heat_source.is_some()),
            ("flow", self.flow.is_some()),
            ("shell", self.shell.is_some()),
            ("sides", self.sides.is_some()),
            ("lid.strain", strain.is_some()),
            ("lid.pressing", pressing.is_some()),
            ("time.interval", self.time.interval != 0.0),
        ];
        if let Some((key, _)) = moving.into_iter().find(|(_, given)| *given) {
            return wrong(key, "given", "only without a plate, where grains expand and walls move");
        }
        self.grains.check(self.temperatures(), &self.gas)?;
        let given = self.lid.as_ref().map(|lid| (lid.pressure.is_some(), lid.porosity.is_some()));
        if let Some((pressure, porosity)) = given
            && pressure == porosity
        {
            let value = if pressure { "pressure and porosity" } else { "neither pressure nor porosity" };
            return wrong("lid", value, "one of pressure and porosity");
        }
        let turned = self.turn.iter().map(|turn| ("turn.down", &turn.down));
        self.check_walls(turned.chain([("plate.wall", &plate.wall)]), true)?;
        if self.record.wall != plate.wall {
            return wrong(
                "record.wall",
                self.record.wall.clone(),
                format!("{}, that of the plate", plate.wall),
            );
        }
        let bottom = self.turn.as_ref().map_or("floor", |turn| turn.down.as_str());
        if plate.pressure.is_some() && plate.wall == bottom {
            let allowed = "no pressure for the wall on which the bed rests, or another plate.wall";
            return wrong("plate.wall", format!("{bottom} with plate.pressure"), allowed);
        }
        let untouched = self.lid.is_none() && plate.pressure.is_none() && bottom != "lid";
        if untouched && plate.wall == "lid" {
            let allowed = "a section [lid] or plate.pressure: else the lid does not touch the bed";
            return wrong("plate.wall", "lid", allowed);
        }
        Ok(())
    }

    /// A bed whose spheres and walls move.
    fn check_moving(&self) -> Result<(), Wrong> {
        let with_plate = [
            ("turn", self.turn.is_some()),
            ("experiment", self.experiment.is_some()),
            ("vary", !self.vary.is_empty()),
        ];
        if let Some((key, _)) = with_plate.into_iter().find(|(_, given)| *given) {
            return wrong(key, "given", "only with a section [plate]");
        }
        self.check_solver()?;
        for temperature in self.heated.iter().filter_map(|heated| heated.temperature.as_ref()) {
            check("heated.temperature", temperature, TEMPERATURES)?;
        }
        self.grains.check(self.temperatures(), &self.gas)?;
        let heated = self.heated.iter().map(|heated| ("heated.wall", &heated.wall));
        self.check_walls(heated.chain([("record.wall", &self.record.wall)]), false)?;
        match self.lid_moves() {
            (Some(_), Some(_)) => {
                return wrong("lid", "strain and pressing", "one of strain and pressing, or neither");
            }
            (Some(path), None) => check("lid.strain", path, STRAINS)?,
            (None, Some(path)) => check("lid.pressing", path, POSITIVE)?,
            (None, None) => {}
        }
        if self.shell.is_some() && self.container.radius.is_none() {
            return wrong("shell", "a box", "a shell around a cylinder: container.radius");
        }
        if let Some(Sides { strain_x, strain_y }) = &self.sides {
            if !self.container.endless {
                return wrong("sides", "given", "a bed without sides: container.endless = true");
            }
            check("sides.strain_x", strain_x, STRAINS)?;
            check("sides.strain_y", strain_y, STRAINS)?;
        }
        if self.record.radius.is_some() != self.container.radius.is_some() {
            return wrong("record.radius", "given or not", "given in a cylinder, and nowhere else");
        }
        let [low, high] = self.record.heights;
        if !low.is_finite() || !high.is_finite() || low >= high {
            return wrong("record.heights", format!("{:?}", self.record.heights), "two rising heights");
        }
        self.check_region()
    }

    /// Refuses averages over fewer spheres than have a mean.
    fn check_region(&self) -> Result<(), Wrong> {
        let (d, [low, high]) = (self.grains.diameter, self.record.heights);
        let short = |length: f64| number(libm::round(1e9 * length) / 1e9);
        if low < 0.0 || high - low < MIN_HEIGHT * d {
            let allowed = format!(
                "two heights above the floor, {MIN_HEIGHT} diameters apart at least: {} m",
                short(MIN_HEIGHT * d)
            );
            return wrong("record.heights", format!("{:?}", self.record.heights), allowed);
        }
        let area = match (self.record.radius, self.container.radius) {
            (Some(inner), Some(radius)) if inner < d || inner > radius => {
                let allowed = format!(
                    "{} to {} m, from a diameter to the radius of the container",
                    short(d),
                    short(radius)
                );
                return wrong("record.radius", number(inner), allowed);
            }
            (Some(inner), _) => PI * inner * inner,
            (None, _) => self.vessel().area(),
        };
        let volume = PI / 6.0 * d * d * d * self.grains.moments().volume;
        let spheres = REFERENCE_FRACTION * area * (high - low) / volume;
        if spheres < MIN_SPHERES {
            let allowed = format!("a region of {MIN_SPHERES} spheres at least: more height, or a wider bed");
            return wrong(
                "record.heights",
                format!("{:?}, about {spheres:.0} spheres", self.record.heights),
                allowed,
            );
        }
        Ok(())
    }

    /// Numbers of all beds.
    fn numbers(&self) -> Vec<Ranged> {
        let (time, distances) = (&self.time, &self.record.distances);
        let mut all = vec![
            temperature("time.initial_temperature", time.initial_temperature),
            ranged("time.end", time.end, POSITIVE),
            ranged("time.tolerance", time.tolerance, POSITIVE),
            ("record.distances", distances.len() as f64, "one at least".into(), !distances.is_empty()),
        ];
        all.extend(distances.iter().map(|&distance| ranged("record.distances", distance, POSITIVE)));
        all
    }

    fn numbers_of(&self, plate: &PlateKeys) -> Vec<Ranged> {
        let lid = |key: fn(&Lid) -> Option<f64>| self.lid.as_ref().and_then(key);
        let (time, output) = (&self.time, self.time.output_every);
        let good = output <= time.end && output >= 1e-5 * time.end;
        let mut all = vec![
            ranged("plate.young_modulus", plate.young_modulus, POSITIVE),
            ranged("plate.hardness", plate.hardness.unwrap_or(1.0), POSITIVE),
            ranged("plate.conductivity", plate.conductivity.unwrap_or(1.0), POSITIVE),
            ranged("plate.pressure", plate.pressure.unwrap_or(1.0), POSITIVE),
            ranged("lid.pressure", lid(|lid| lid.pressure).unwrap_or(1.0), POSITIVE),
            ranged("plate.poisson_ratio", plate.poisson_ratio, POISSON_RATIOS),
            emissivity("plate.emissivity", plate.emissivity.unwrap_or(1.0), "reflects everything"),
            ("time.output_every", output, PLATE_OUTPUT.into(), good),
            rough("plate.roughness", plate.roughness),
            temperature("plate.temperature", plate.temperature),
        ];
        all.extend(lid(|lid| lid.porosity).map(|porosity| ranged("lid.porosity", porosity, POROSITIES)));
        all
    }

    fn numbers_of_moving(&self) -> Vec<Ranged> {
        let time = &self.time;
        let of_shell = |key: fn(&Shell) -> f64, none: f64| self.shell.as_ref().map_or(none, key);
        let interval = time.interval >= 1e-5 * time.end && time.interval <= time.output_every;
        vec![
            ("time.interval", time.interval, INTERVAL.into(), interval),
            ("time.output_every", time.output_every, OUTPUT_EVERY.into(), time.output_every <= time.end),
            ranged("time.steps", time.steps as f64, STEPS),
            ranged("heat_source", self.heat_source.unwrap_or(0.0), SOURCES),
            ranged("lid.pressure", self.pressure(), POSITIVE),
            ranged("shell.young_modulus", of_shell(|shell| shell.young_modulus, 1.0), POSITIVE),
            ranged("shell.thickness", of_shell(|shell| shell.thickness, 1.0), POSITIVE),
            ranged("record.radius", self.record.radius.unwrap_or(1.0), POSITIVE),
            ranged("shell.thermal_expansion", of_shell(|shell| shell.thermal_expansion, 0.0), EXPANSIONS),
        ]
    }
}
