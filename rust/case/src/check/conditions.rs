//! Checks conditions of T at patches that OpenFOAM reads, or does not know, and `msddFoam` cannot solve with.

use super::domain::Mesh;
use super::finding::Findings;
use super::keys;
use crate::dictionary::{Dictionary, Entry};

/// Path in the case folder.
const FILE: &str = "0/T";
/// Types of patches that need a condition of their own type.
const CONSTRAINTS: [&str; 5] = ["empty", "wedge", "symmetry", "cyclic", "processor"];
/// Conditions that ask whether something flows in or out.
const OF_FLOWS: [&str; 4] = ["inletOutlet", "outletInlet", "uniformInletOutlet", "freestream"];
/// Conditions that need a patch beside another region.
const OF_NEIGHBOURS: [&str; 3] = [
    "compressible::turbulentTemperatureCoupledBaffleMixed",
    "compressible::turbulentTemperatureRadCoupledMixed",
    "granularContact",
];
/// Where a condition may take its conductivity from, but not in `msddFoam`.
const OF_THERMO: [&str; 3] = ["solidThermo", "fluidThermo", "directionalSolidThermo"];
/// Conductivities that lag behind the step.
const OF_OUTPUT: [&str; 3] = ["conductivity", "Kxx", "Kyy"];
/// All conditions of a scalar that OpenFOAM v1912 has in `msddFoam` without further libraries.
const KNOWN: &str = "
MarshakRadiation MarshakRadiationFixedTemperature advective alphatJayatillekeWallFunction calculated codedFixedValue
codedMixed compressible::alphatJayatillekeWallFunction compressible::alphatWallFunction
compressible::thermalBaffle1D<hConstSolidThermoPhysics> compressible::thermalBaffle1D<hPowerSolidThermoPhysics>
compressible::turbulentTemperatureCoupledBaffleMixed compressible::turbulentTemperatureRadCoupledMixed
convectiveHeatTransfer cyclic cyclicACMI cyclicAMI cyclicSlip directionMixed empty energyJump energyJumpAMI
epsilonWallFunction exprFixedValue exprMixed externalWallHeatFluxTemperature extrapolatedCalculated fWallFunction fan
fanPressure fixedEnergy fixedFluxExtrapolatedPressure fixedFluxPressure fixedGradient fixedIncidentRadiation
fixedInternalValue fixedJump fixedJumpAMI fixedMean fixedMeanOutletInlet fixedPressureCompressibleDensity fixedProfile
fixedUnburntEnthalpy fixedValue freestream freestreamPressure gradientEnergy gradientUnburntEnthalpy
greyDiffusiveRadiation greyDiffusiveRadiationViewFactor inletOutlet inletOutletTotalTemperature interfaceCompression
kLowReWallFunction kqRWallFunction lumpedMassWallTemperature mapped mappedField mappedFixedInternalValue
mappedFixedPushedInternalValue mixed mixedEnergy mixedUnburntEnthalpy nonuniformTransformCyclic nutLowReWallFunction
nutTabulatedWallFunction nutUBlendedWallFunction nutURoughWallFunction nutUSpaldingWallFunction nutUWallFunction
nutkRoughWallFunction nutkWallFunction omegaWallFunction outletInlet outletMachNumberPressure outletMappedUniformInlet
outletMappedUniformInletHeatAddition partialSlip phaseHydrostaticPressure plenumPressure porousBafflePressure
prghPressure prghTotalHydrostaticPressure prghTotalPressure processor processorCyclic rotatingTotalPressure
scaledFixedValue sliced slip symmetry symmetryPlane syringePressure timeVaryingMappedFixedValue
totalFlowRateAdvectiveDiffusive totalPressure totalTemperature turbulentInlet turbulentIntensityKineticEnergyInlet
turbulentMixingLengthDissipationRateInlet turbulentMixingLengthFrequencyInlet uniformDensityHydrostaticPressure
uniformFixedGradient uniformFixedValue uniformInletOutlet uniformJump uniformJumpAMI uniformTotalPressure
v2WallFunction variableHeightFlowRate wallHeatTransfer waveSurfacePressure waveTransmissive wedge
wideBandDiffusiveRadiation zeroGradient";

/// Checks the conditions of T. `alone`: whether `msddFoam` solves the bed; regions have a thermo of OpenFOAM. `closed`: whether no library
/// adds conditions.
pub fn check(temperature: &Dictionary, mesh: &Mesh, [alone, closed]: [bool; 2], found: &mut Findings) {
    let Ok(boundary) = temperature.dictionary_at("boundaryField") else { return };
    for [name, patch] in &mesh.patches {
        let Some(Entry::Dictionary(condition)) = mesh.condition(boundary, name) else { continue };
        let Ok(kind) = condition.text("type") else { continue };
        let mut refuse = |key: &str, value: &str, allowed: &str, advice: &str| {
            let place = condition.path_of(key);
            // A pattern may stand for several patches, and is reported once
            if !found.0.iter().any(|finding| finding.key == place && finding.file == FILE) {
                found.error([FILE, &place], value, allowed, advice);
            }
        };
        let kind = kind.as_str();
        if kind == "fixedValue" && condition.get("value").is_none() {
            refuse("value", "missing", "uniform and a temperature [K]", "");
        }
        if OF_NEIGHBOURS.contains(&kind) && !patch.starts_with("mapped") {
            let allowed = format!("on patches of type mappedWall, and {name} is of type {patch}");
            refuse("type", kind, &allowed, "This condition looks at the wall of another region");
        }
        if !alone {
            continue;
        }
        if kind == "calculated" && !CONSTRAINTS.iter().any(|constraint| patch.starts_with(constraint)) {
            let advice = "That is what tools such as createBaffles leave at new patches, and says nothing of the temperature there";
            refuse("type", kind, "a condition such as fixedValue or zeroGradient", advice);
        }
        if OF_FLOWS.contains(&kind) {
            let advice = "Nothing flows through a bed: the flux that this condition looks for is not there";
            refuse("type", kind, "a condition such as fixedValue or zeroGradient", advice);
        }
        let kappa = condition.text("kappaMethod").unwrap_or_default();
        if OF_THERMO.contains(&kappa.as_str()) {
            let advice = "msddFoam has no thermo of OpenFOAM; the conductivity of the bed at the wall is K";
            refuse("kappaMethod", &kappa, "lookup, with kappa K", advice);
        }
        let known: Vec<&str> = KNOWN.split_whitespace().chain(OF_NEIGHBOURS).collect();
        if closed && !known.contains(&kind) {
            let advice = match keys::nearest(kind, &known) {
                Some(near) => format!("OpenFOAM does not know this condition: is '{near}' meant?"),
                None => "OpenFOAM does not know this condition without the library that has it".to_string(),
            };
            let allowed = "a condition of OpenFOAM, or of a library in libs of system/controlDict";
            refuse("type", kind, allowed, &advice);
        }
        let kappa = condition.text("kappa").unwrap_or_default();
        let place = condition.path_of("kappa");
        let is_new = !found.0.iter().any(|finding| finding.key == place);
        if condition.get("kappaMethod").is_some() && OF_OUTPUT.contains(&kappa.as_str()) && is_new {
            let advice = "The others are those of the last output, not of the step, and some runs are refused with them";
            found.doubt([FILE, &place], &kappa, "K, the conductivity of the bed at the wall", advice);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn lines(condition: &str, patch: &str, ways: [bool; 2]) -> Vec<String> {
        let text = format!("boundaryField {{ \".*\" {{ {condition} }} }}");
        let file = Dictionary::parse(Path::new(FILE), &text).unwrap();
        let patches = [["left", patch], ["right", patch]].map(|pair| pair.map(str::to_string)).to_vec();
        let mut found = Findings::default();
        check(&file, &Mesh { patches, ..Mesh::default() }, ways, &mut found);
        found.0.iter().map(ToString::to_string).collect()
    }

    const ALONE: [bool; 2] = [true, true];
    const REGION: [bool; 2] = [false, false];
    const EXTERNAL: &str = "type externalWallHeatFluxTemperature; mode flux; q uniform 9; kappaMethod";
    const COUPLED: &str = "type compressible::turbulentTemperatureCoupledBaffleMixed; kappaMethod";

    #[test]
    fn conditions_that_the_solver_takes_pass() {
        for good in [
            "type zeroGradient;",
            "type fixedValue; value uniform 300;",
            "type codedFixedValue; value uniform 300;",
            &format!("{EXTERNAL} lookup; kappa K;"),
        ] {
            assert_eq!(lines(good, "wall", ALONE), Vec::<String>::new(), "{good}");
        }
        for constraint in ["empty", "processor", "symmetryPlane"] {
            assert_eq!(lines("type calculated;", constraint, ALONE), Vec::<String>::new());
        }
        assert_eq!(lines(&format!("{COUPLED} lookup;"), "mappedWall", ALONE), Vec::<String>::new());
        for good in [EXTERNAL, COUPLED] {
            assert_eq!(lines(&format!("{good} solidThermo;"), "mappedWall", REGION), Vec::<String>::new());
        }
        // A library may have it
        assert_eq!(lines("type groovyBC;", "wall", [true, false]), Vec::<String>::new());
    }

    #[test]
    fn conditions_that_end_the_run_are_found_once() {
        for (wrong, message) in [
            ("type fixedValue;", "value = missing, allowed: uniform and a temperature [K]"),
            ("type calculated; value uniform 0;", "type = calculated, allowed: a condition such as"),
            ("type inletOutlet; inletValue uniform 300;", "type = inletOutlet, allowed: a condition such as"),
            (&format!("{EXTERNAL} solidThermo;"), "kappaMethod = solidThermo, allowed: lookup, with kappa K"),
            (
                "type granularContact;",
                "type = granularContact, allowed: on patches of type mappedWall, and left",
            ),
            ("type fixedValu; value uniform 300;", "type = fixedValu, allowed: a condition of OpenFOAM"),
        ] {
            let all = lines(wrong, "wall", ALONE);
            let start = format!("error: 0/T: boundaryField/.*/{message}");
            assert!(all.len() == 1 && all[0].starts_with(&start), "{start}\n{all:#?}");
        }
        let all = lines(&format!("{COUPLED} solidThermo;"), "wall", REGION);
        assert!(all.len() == 1 && all[0].contains("and left is of type wall"), "{all:?}");
        let lags = lines(&format!("{EXTERNAL} lookup; kappa conductivity;"), "wall", ALONE);
        let start =
            "doubt: 0/T: boundaryField/.*/kappa = conductivity, allowed: K, the conductivity of the bed";
        assert!(lags.len() == 1 && lags[0].starts_with(start), "{lags:?}");
        assert!(lines("type fixedValu;", "wall", ALONE)[0].ends_with("is 'fixedValue' meant?"));
    }
}
