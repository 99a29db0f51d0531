//! Checks that spheres conduct at least as well as the gas between them, as the law of spheres needs, and that the gas is known at the
//! temperatures of the bed.

use super::finding::Findings;
use super::grains::FILE;
use super::temperatures::Temperatures;
use super::{keys, tables};
use crate::dictionary::Dictionary;
use crate::numbers::rounded;
use crate::spheres::start::ACCOMMODATION;
use msdd_beds::effective::{BedMaterial, LEAST_RATIO};
use msdd_beds::named_gases::GasName;
use msdd_beds::solid::Solid;
use msdd_rve::message::number;
use msdd_surrogate::spheres::readout::GAS_RANGE;

/// `properties` with the surrogate type spheres; nothing is done for others.
pub fn check(properties: &Dictionary, temperatures: &Temperatures, found: &mut Findings) {
    let Some(gas) = gas_of(properties) else { return };
    let advice = "The law of spheres does not know spheres that conduct less than the gas between them";
    if let Some(case) = below(properties, gas, temperatures.at_start()) {
        let [value, allowed] = texts(gas, case);
        found.error([FILE, KEY], &value, &allowed, &format!("{advice}, and the solver refuses them"));
        return;
    }
    if let Some(case) = below(properties, gas, temperatures.later()) {
        let [value, allowed] = texts(gas, case);
        let advice = format!("{advice}: the run ends when a cell reaches this temperature");
        found.doubt([FILE, KEY], &value, &allowed, &advice);
    }
}

/// Doubts temperatures of the start and of walls at which the gas is not known.
pub fn check_range(
    properties: &Dictionary,
    temperatures: &Temperatures,
    walls: &[(String, Vec<f64>)],
    found: &mut Findings,
) {
    let Some(gas) = gas_of(properties) else { return };
    let [low, high] = gas.range();
    let outside = |t: &f64| *t >= 0.0 && !(low..=high).contains(t);
    let mut doubt = |place: &str, t: f64| {
        let value = format!("{} K", number(rounded(t, 5)));
        let allowed = format!("{} to {} K, where {} is known", number(low), number(high), gas.as_str());
        let advice =
            "Beyond, the solver takes the gas as it is at the nearest of these; temperatures are in Kelvin";
        found.doubt(["0/T", place], &value, &allowed, advice);
    };
    if let Some(t) = temperatures.at_start().find(outside) {
        doubt("internalField", t);
    }
    for (name, values) in walls {
        if let Some(&t) = values.iter().find(|t| outside(t)) {
            doubt(&format!("boundaryField/{name}"), t);
        }
    }
}

/// Doubts a pressure of the gas at which the law does not know it between spheres of this size, at the start.
pub fn check_pressure(properties: &Dictionary, temperatures: &Temperatures, found: &mut Findings) {
    let (Some(gas), Ok(surrogate)) = (gas_of(properties), properties.dictionary_at("surrogate")) else {
        return;
    };
    let Ok(own) = surrogate.dictionary_at("spheresCoeffs") else { return };
    let [low, high] = gas.range();
    let Some(temperature) = temperatures.at_start().next().filter(|t| (low..=high).contains(t)) else {
        return;
    };
    let (Some(radius), Some(solid)) = (
        keys::size(properties, "meanRadius"),
        keys::size(properties, KEY).or_else(|| tables::at(properties, KEY, temperature)),
    ) else {
        return;
    };
    // Neither stiffness nor roughness counts for the gas
    let solid = Solid { conductivity: solid, effective_modulus: 1.0, roughness: None };
    let accommodation = keys::number(own, "accommodation", "").unwrap_or(ACCOMMODATION);
    let knows = |gas_pressure: f64| {
        let bed = BedMaterial { radius, solid, gas, gas_pressure, accommodation };
        bed.gas_at(temperature).is_none_or(|gas| bed.knows(&gas, GAS_RANGE))
    };
    let given = keys::number(own, "gasPressure", "").unwrap_or(USUAL_PRESSURE);
    if knows(given) {
        return;
    }
    let tried = || TRIED.map(|k| 10f64.powf(f64::from(k) / 10.0)).filter(|&pressure| knows(pressure));
    let allowed = match (tried().next(), tried().next_back()) {
        (Some(least), Some(most)) => {
            let [least, most] = [least, most].map(|pressure| number(rounded(pressure, 2)));
            format!("about {least} to {most} Pa between these spheres")
        }
        _ => "none between these spheres".to_string(),
    };
    let advice = "Beyond, the law of spheres does not know the gas: the solver answers as well as it can, and marks all cells by \
                  inRegion = 0. Is meanRadius in metres?";
    let value = format!("{} Pa", number(given));
    found.doubt([FILE, &own.path_of("gasPressure")], &value, &allowed, advice);
}

/// The first of these temperatures at which the spheres conduct less than the gas, and both conductivities.
fn below(properties: &Dictionary, gas: GasName, mut all: impl Iterator<Item = f64>) -> Option<[f64; 3]> {
    let number = keys::size(properties, KEY);
    all.find_map(|t| {
        let solid = number.or_else(|| tables::at(properties, KEY, t))?;
        let gas = conductivity(gas, t)?;
        (solid < LEAST_RATIO * gas).then_some([t, solid, gas])
    })
}

const KEY: &str = "thermalConductivity";
/// The solver's default \[Pa\].
const USUAL_PRESSURE: f64 = 101_300.0;
/// Tenths of powers of ten of the pressures that are tried to find those that the law knows.
const TRIED: std::ops::RangeInclusive<i32> = -30..=90;

/// The gas of the law of spheres, if there is one.
fn gas_of(properties: &Dictionary) -> Option<GasName> {
    let surrogate = properties.dictionary_at("surrogate").ok()?;
    let name = surrogate.dictionary_at("spheresCoeffs").ok()?.text("gas").ok()?;
    let is_law = surrogate.text("type").is_ok_and(|kind| kind == "spheres");
    GasName::ALL.into_iter().find(|gas| is_law && gas.as_str() == name)
}

/// \[W/(m K)\]; none in a vacuum. It does not depend on the pressure.
fn conductivity(gas: GasName, temperature: f64) -> Option<f64> {
    let [low, high] = gas.range();
    gas.at(temperature.clamp(low, high), 1e5, 1.0).map(|gas| gas.conductivity)
}

fn texts(gas: GasName, [temperature, solid, least]: [f64; 3]) -> [String; 2] {
    let short = |value: f64| number(rounded(value, 4));
    let value = format!("{} W/(m K) at {} K", short(solid), number(rounded(temperature, 5)));
    [value, format!("at least that of the gas ({}), which is {} W/(m K) there", gas.as_str(), short(least))]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::fields::Values;
    use std::path::Path;

    fn lines(conductivity: &str, gas: &str, start: f64, walls: &[f64], heated: bool) -> Vec<String> {
        let text = format!(
            "thermalConductivity {conductivity}; surrogate {{ type spheres; spheresCoeffs {{ poissonRatio 0.3; {gas} }} }}"
        );
        let properties = Dictionary::parse(Path::new(FILE), &text).unwrap();
        let start = Values { numbers: vec![vec![start]], uniform: true };
        let temperatures = Temperatures { start: Some(&start), walls: walls.to_vec(), heated };
        let mut found = Findings::default();
        check(&properties, &temperatures, &mut found);
        found.0.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn spheres_that_conduct_less_than_the_gas_at_the_start_are_refused() {
        let helium = "gas helium;";
        assert_eq!(
            lines("0.2", helium, 673.15, &[], false),
            [
                "error: constant/granularProperties: thermalConductivity = 0.2 W/(m K) at 673.15 K, allowed: at least that of the gas \
                 (helium), which is 0.2733 W/(m K) there. The law of spheres does not know spheres that conduct less than the gas \
                 between them, and the solver refuses them"
            ]
        );
        for [good, gas] in
            [["0.2", "gas air;"], ["0.3", helium], ["1e-3", "gas vacuum;"], ["1e-3", ""], ["sine", helium]]
        {
            assert_eq!(lines(good, gas, 673.15, &[], false), Vec::<String>::new(), "{good} {gas}");
        }
        let named = "k [1 1 -3 -1 0 0 0] 0.2";
        assert!(lines(named, helium, 673.15, &[], false)[0].starts_with("error"));
    }

    #[test]
    fn a_gas_too_thin_for_the_spheres_is_doubted() {
        let lines = |radius: &str, pressure: &str| {
            let text = format!(
                "thermalConductivity 1; meanRadius {radius}; surrogate {{ type spheres; spheresCoeffs {{ gas air; gasPressure {pressure}; }} }}"
            );
            let properties = Dictionary::parse(Path::new(FILE), &text).unwrap();
            let start = Values { numbers: vec![vec![293.0]], uniform: true };
            let temperatures = Temperatures { start: Some(&start), walls: vec![], heated: false };
            let mut found = Findings::default();
            check_pressure(&properties, &temperatures, &mut found);
            found.0.iter().map(ToString::to_string).collect::<Vec<_>>()
        };
        assert_eq!(lines("2e-3", "1e5"), Vec::<String>::new());
        let found = lines("1e-5", "10");
        let wanted = "doubt: constant/granularProperties: surrogate/spheresCoeffs/gasPressure = 10 Pa, allowed: about ";
        assert!(found.len() == 1 && found[0].starts_with(wanted), "{found:?}");
    }

    #[test]
    fn temperatures_at_which_the_gas_is_not_known_are_doubted() {
        let lines = |gas: &str, start: f64, wall: f64| {
            let text = format!("surrogate {{ type spheres; spheresCoeffs {{ gas {gas}; }} }}");
            let properties = Dictionary::parse(Path::new(FILE), &text).unwrap();
            let start = Values { numbers: vec![vec![start]], uniform: true };
            let temperatures = Temperatures { start: Some(&start), walls: vec![wall], heated: false };
            let mut found = Findings::default();
            check_range(&properties, &temperatures, &[("left".to_string(), vec![300.0, wall])], &mut found);
            found.0.iter().map(ToString::to_string).collect::<Vec<_>>()
        };
        assert_eq!(lines("air", 200.0, 2000.0), Vec::<String>::new());
        assert_eq!(lines("vacuum", 20.0, 9000.0), Vec::<String>::new());
        assert_eq!(
            lines("helium", 27.0, 2000.0),
            ["internalField = 27 K", "boundaryField/left = 2000 K"].map(|place| format!(
                "doubt: 0/T: {place}, allowed: 273 to 1800 K, where helium is known. Beyond, the solver takes the gas as it is at the \
                 nearest of these; temperatures are in Kelvin"
            ))
        );
    }

    #[test]
    fn spheres_that_conduct_less_where_a_wall_or_a_source_warms_them_are_doubted() {
        let (falls, helium) = ("table ((300 3.2) (700 0.3) (1300 0.2))", "gas helium;");
        assert_eq!(lines(falls, helium, 673.15, &[600.0, 700.0], false), Vec::<String>::new());
        for (walls, heated) in [(vec![900.0], false), (vec![], true)] {
            let found = lines(falls, helium, 673.15, &walls, heated);
            assert_eq!(found.len(), 1);
            let [start, end] = [
                "doubt: constant/granularProperties: thermalConductivity = 0.2928 W/(m K) at 743.15 K, allowed: at least that of the gas",
                "the run ends when a cell reaches this temperature",
            ];
            assert!(found[0].starts_with(start) && found[0].ends_with(end), "{found:?}");
        }
        // A cold wall, and a polynomial
        let rises = "polynomial ((-0.2 0) (0.001 1))";
        assert!(lines(rises, helium, 673.15, &[300.0], false)[0].contains("W/(m K) at 3"));
    }
}
