//! Reports code in a case, because it runs with the rights of whoever runs the case.

use super::finding::Findings;
use crate::dictionary::{Dictionary, Entry, Token};

/// The library that makes a region of OpenFOAM's own solvers a bed.
pub const BEDS: &str = "libgranularThermo.so";

/// Libraries that come with this project or with OpenFOAM, without `lib` and `.so`. Others contain code of somebody else.
const KNOWN: &str = "
granularFunctionObjects granularModels granularThermo
CompressibleMultiPhaseTurbulenceModels CompressibleTwoPhaseMixtureTurbulenceModels DPMTurbulenceModels DSMC
IncompressibleMultiphaseSystems MGridGen ODE OpenFOAM Pstream SLGThermo SloanRenumber
VoFphaseCompressibleTurbulenceModels adjointOptimisation atmosphericModels barotropicCompressibilityModel blockMesh
chemistryModel coalCombustion combustionModels compressibleEulerianInterfacialModels
compressibleMultiphaseEulerianInterfacialModels compressibleTransportModels compressibleTurbulenceModels
compressibleTwoPhaseSystem conversion decompose decompositionMethods distributed distributionModels
driftFluxRelativeVelocityModels driftFluxTransportModels dynamicFvMesh dynamicMesh engine extrude2DMesh extrudeModel
fieldFunctionObjects fileFormats finiteArea finiteVolume fluidThermophysicalModels forces fvMotionSolvers fvOptions
genericPatchFields helpTypes immiscibleIncompressibleTwoPhaseMixture incompressibleTransportModels
incompressibleTurbulenceModels initialisationFunctionObjects interfaceProperties interfaceTrackingFvMesh kahipDecomp
lagrangian lagrangianFunctionObjects lagrangianIntermediate lagrangianSpray lagrangianTurbulence
laminarFlameSpeedModels laserDTRM liquidPropertiesFvPatchFields lumpedPointMotion massTransferModels meshTools
metisDecomp molecularMeasurements molecule multiphaseInterFoam multiphaseMixtureThermo
multiphaseReactingTurbulenceModels multiphaseSystem overset pairPatchAgglomeration phaseChangeTwoPhaseMixtures
phaseCompressibleTurbulenceModels phaseTemperatureChangeTwoPhaseMixtures potential ptscotchDecomp pyrolysisModels
radiationModels randomProcesses randomProcessesFunctionObjects reactingEulerFoamFunctionObjects
reactingEulerianFvPatchFields reactingEulerianInterfacialCompositionModels reactingEulerianInterfacialModels
reactingMultiphaseSystem reactingPhaseSystem reactingTwoPhaseSystem reactionThermophysicalModels reconstruct
regionCoupling regionModels renumberMethods rhoCentralFoam rigidBodyDynamics rigidBodyMeshMotion
runTimePostProcessing sampling scotchDecomp semiPermeableBaffle sixDoFRigidBodyMotion sixDoFRigidBodyState
snappyHexMesh solidChemistryModel solidParticle solidSpecie solidThermo solverFunctionObjects specie surfMesh
surfaceFeatureExtract surfaceFilmDerivedFvPatchFields surfaceFilmModels tabulatedWallFunctions thermalBaffleModels
thermophysicalProperties topoChangerFvMesh turbulenceModelSchemes turbulenceModels twoPhaseMixture
twoPhaseMixtureThermo twoPhaseProperties twoPhaseReactingTurbulenceModels twoPhaseSurfaceTension
utilityFunctionObjects waveModels";

/// Name of a library without `lib` and `.so`, which may both be missing.
fn bare(name: &str) -> &str {
    let name = name.strip_suffix(".so").unwrap_or(name);
    name.strip_prefix("lib").unwrap_or(name)
}

/// Whether a list has the library that makes a region a bed.
pub fn has_beds(libraries: &[Token]) -> bool {
    libraries.iter().any(|library| bare(&library.text) == bare(BEDS))
}

/// Reports libraries and source code in a `controlDict`.
pub fn check(file: &str, control: &Dictionary, found: &mut Findings) {
    check_libraries(file, control, found);
    let Ok(functions) = control.dictionary_at("functions") else { return };
    for key in functions.keys() {
        let Some(Entry::Dictionary(function)) = functions.get_any(&key.text) else { continue };
        check_libraries(file, function, found);
        let kind = function.text("type").unwrap_or_default();
        if kind.starts_with("coded") {
            let advice =
                "This function is source code that the run compiles and starts, with all your rights";
            found.doubt([file, &functions.path_of(&key.text)], &kind, "", advice);
        }
    }
}

fn check_libraries(file: &str, dictionary: &Dictionary, found: &mut Findings) {
    let is_known = |name: &str| KNOWN.split_whitespace().any(|known| known == bare(name));
    for key in ["libs", "functionObjectLibs"] {
        let tokens = dictionary.value(key).unwrap_or_default();
        // The number of libraries may stand in front of their list
        let list = match tokens {
            [count, list @ ..] if count.text.parse::<usize>().is_ok() => list,
            list => list,
        };
        let names = list.iter().filter(|token| !["(", ")"].contains(&token.text.as_str()));
        for token in names.filter(|token| !is_known(&token.text)) {
            let advice = "This library does not come with OpenFOAM or MSDD as far as is known here: running the case runs its code, \
                          with all your rights. Run it only if you trust who wrote it";
            found.doubt([file, &dictionary.path_of(key)], &token.text, "", advice);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    const FILE: &str = "system/controlDict";

    fn lines(text: &str) -> Vec<String> {
        let control = Dictionary::parse(Path::new(FILE), text).unwrap();
        let mut found = Findings::default();
        check(FILE, &control, &mut found);
        found.0.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn libraries_of_openfoam_are_known_in_all_their_spellings() {
        let known = "libs 2 (\"libfvOptions.so\" granularThermo); functions { m { libs (fieldFunctionObjects); } p { functionObjectLibs (\"libsampling.so\"); } }";
        assert_eq!(lines(known), Vec::<String>::new());
        for strange in
            ["libs (mine);", "libs (\"./libsampling.so\");", "functionObjectLibs (\"libmine.so\");"]
        {
            let found = lines(&format!("functions {{ f {{ {strange} }} }}"));
            assert!(
                found.len() == 1 && found[0].starts_with("doubt: system/controlDict: functions/f/"),
                "{found:?}"
            );
        }
    }
}
