//! Keys of the case files that `msddFoam` and its function objects read.

use crate::cpp::{
    allowed_keys, allowed_list, lookups as lookups_of, selectable, source, with_literals, with_units,
    without_comments, words_of,
};
use crate::set::{Cell, Set};
use crate::sources::{self, firsts, strings};

const GRAINS: &str = "reference/granular-properties.md";
const SYSTEM: &str = "reference/system.md";
const OBJECTS: &str = "reference/function-objects.md";
const BEDS: &str = "reference/regions.md";
const PROPERTIES: &str = "openfoam/granularModels/granularProperties/granularProperties.C";
const MODEL: &str = "openfoam/granularModels/granularModel/granularModel.C";
const REGION: &str = "openfoam/granularModels/regionPolicy/regionPolicy.C";
const WALLS: &str = "openfoam/granularModels/granularMechanics/wallConditions.C";
const EQUILIBRIUM: &str = "openfoam/granularModels/granularMechanics/equilibrium.C";
const LAW: &str = "openfoam/granularModels/granularMechanics/stressLaw.C";
const START: &str = "openfoam/granularModels/granularState/granularStateStart.C";
const LINEAR: &str = "openfoam/granularModels/granularMechanics/equilibriumSolver.C";
const SCHEME: &str = "openfoam/msddFoam/timeScheme/timeScheme.C";
const THERMO: &str = "openfoam/granularThermo/granularSolidThermo/granularSolidThermo.C";
const AXES: &str = "openfoam/granularThermo/principalAxes/principalAxes.C";
const CONTACT: &str = "openfoam/granularThermo/granularContact/granularContactFvPatchScalarField.C";
const SECOND: &str = "openfoam/msddFoam/timeScheme/secondOrderScheme.C";

/// Texts that are looked up in the solver and are no keys of a user.
pub const NO_KEYS: [(&str, &str); 10] = [
    ("accept", "option of the command line, in the table of msddFoam"),
    ("mesh", "name given with this option"),
    ("solvers", "dictionary of every fvSolution"),
    ("equilibrium", "heading of the table solvers.equilibrium"),
    ("solid", "kind of region in every regionProperties"),
    ("beyondSince", "entry of course in uniform/msddFoam, in the row of course"),
    ("PIMPLE", "dictionary of OpenFOAM's regions"),
    ("timeStart", "of function objects, in their table"),
    ("timeEnd", "of function objects, in their table"),
    ("kappa", "of conditions of OpenFOAM, which is refused with other values than K"),
];

/// Keys of controlDict that OpenFOAM's Time reads for us.
const OF_TIME: [(&str, &str); 4] = [
    ("endTime", "Time::endTime()"),
    ("deltaT", "Time::deltaTValue()"),
    ("writeFormat", "OpenFOAM writes the fields"),
    ("writePrecision", "OpenFOAM writes the fields"),
];

/// Keys of function objects that their base classes read.
const OF_FUNCTION_OBJECTS: [(&str, &str); 8] = [
    ("type", "functionObject::New"),
    ("libs", "functionObjectList"),
    ("writeControl", "timeControl"),
    ("writeInterval", "timeControl"),
    ("timeStart", "timeControl"),
    ("timeEnd", "timeControl"),
    ("writePrecision", "writeFile"),
    ("enabled", "functionObjects::timeControl"),
];

/// The solver's sources, without comments.
pub fn all_sources() -> Vec<(String, String)> {
    let files = sources::files("openfoam", &["C", "H"]);
    files.into_iter().map(|(path, text)| (path, without_comments(&text))).collect()
}

/// File and key of everything that is looked up in a dictionary.
pub fn lookups() -> Vec<(String, String)> {
    let found = |(path, text): (String, String)| {
        lookups_of(&text).into_iter().map(|key| (path.clone(), key)).collect::<Vec<_>>()
    };
    all_sources().into_iter().flat_map(found).collect()
}

/// The page for keys that a source reads.
pub fn page_of(file: &str) -> &'static str {
    let pages = [
        ("openfoam/functionObjects", OBJECTS),
        ("openfoam/granularThermo", BEDS),
        ("openfoam/msddFoam", SYSTEM),
        ("openfoam/granularModels/granularState", SYSTEM),
        (LINEAR, SYSTEM),
        ("openfoam/granularModels/runRecord", "reference/fields.md"),
    ];
    pages.iter().find(|(folder, _)| file.starts_with(folder)).map_or(GRAINS, |(_, page)| page)
}

pub fn sets() -> Vec<Set> {
    [grains(), surrogates(), regions(), equilibrium(), system(), function_objects(), beds()].concat()
}

fn grains() -> Vec<Set> {
    let text = source(PROPERTIES);
    let all = all_sources();
    let set = Set::new(GRAINS, "granularProperties", PROPERTIES, allowed_keys(&text, "*this"))
        .but(&[("FoamFile", "head of every file of OpenFOAM")])
        .with_words("bulkDensity", "allowed", &words_of("bulkDensityModelNames", &text))
        .with_words("mechanics", "allowed", &selectable("granularMechanics", &all));
    let mechanics = source("openfoam/granularModels/granularMechanics/granularMechanics.C");
    vec![with_literals(with_units(set, &text), &(text + &mechanics))]
}

fn surrogates() -> Vec<Set> {
    let types = selectable("granularModel", &all_sources());
    let mut keys = allowed_list(&source(MODEL));
    keys.extend(types.iter().map(|name| format!("{name}Coeffs")));
    let header = source("openfoam/granularModels/granularProperties/granularProperties.H");
    let surrogate = Set::new(GRAINS, "surrogate", MODEL, keys).with_words("type", "allowed", &types);
    // The default of smallestStrain is an argument of its function, that of most models.
    let surrogate = with_literals(surrogate, &(source(MODEL) + &header)).with(
        "smallestStrain",
        "default",
        Cell::Number(0.0),
    );
    let mut sets = vec![surrogate];
    for name in types {
        let folder = format!("openfoam/granularModels/{name}Model");
        let text: String =
            sources::files(&folder, &["C", "H"]).iter().map(|(_, text)| without_comments(text)).collect();
        let set = Set::new(GRAINS, &format!("{name}Coeffs"), &folder, allowed_keys(&text, "coeffs_"));
        sets.push(with_literals(set, &text));
        if name == "spheres" {
            let wall = Set::new(GRAINS, "wall of spheresCoeffs", &folder, allowed_keys(&text, "dict"));
            sets.push(with_literals(wall, &text));
        }
    }
    sets
}

fn regions() -> Vec<Set> {
    let text = source(REGION);
    let mut keys = allowed_list(&text);
    keys.extend(firsts(r#"names_\.append\("(\w+)"\)"#, &text));
    let actions = words_of("actionNames", &text);
    let sides = Set::new(GRAINS, "sides of outOfRegion", REGION, allowed_keys(&text, "dict"))
        .with_words("below", "allowed", &actions)
        .with_words("above", "allowed", &actions);
    vec![
        with_literals(Set::new(GRAINS, "outOfRegion", REGION, keys), &text),
        sides,
        Set::new(GRAINS, "actions", REGION, actions),
    ]
}

fn equilibrium() -> Vec<Set> {
    let text = source(EQUILIBRIUM);
    let walls = source(WALLS);
    let kinds = words_of("kindNames", &walls);
    let set =
        Set::new(GRAINS, "walls", WALLS, allowed_keys(&walls, "dict")).with_words("type", "allowed", &kinds);
    vec![
        with_literals(
            Set::new(GRAINS, "equilibriumCoeffs", EQUILIBRIUM, allowed_keys(&text, "dict_")),
            &text,
        ),
        with_literals(set, &walls),
        Set::new(GRAINS, "types of walls", WALLS, kinds),
        with_literals(
            Set::new(GRAINS, "restStress", START, allowed_keys(&source(START), "dict")),
            &source(START),
        ),
        Set::new(GRAINS, "elasticCoeffs", LAW, allowed_keys(&source(LAW), "dict")),
        Set::new(SYSTEM, "solvers.equilibrium", LINEAR, allowed_keys(&source(LINEAR), "controls")),
    ]
}

fn system() -> Vec<Set> {
    let scheme = source(SCHEME);
    let schemes = selectable("timeScheme", &all_sources());
    let msdd_foam = Set::new(SYSTEM, "msddFoam", SCHEME, allowed_keys(&scheme, "dict")).with_words(
        "timeScheme",
        "allowed",
        &schemes,
    );
    // What is read of controlDict, by the names that the sources have for it.
    let control_names = r#"(?:controlDict\(\)|\bcontrol)\s*\.\s*\w+(?:<\w+>)?\s*\(\s*"(\w+)""#;
    let mut keys: Vec<String> =
        all_sources().iter().flat_map(|(_, text)| firsts(control_names, text)).collect();
    let restart = source("openfoam/msddFoam/restartTime.C");
    keys.extend(firsts(r#"\bdict\.\w+(?:<\w+>)?\(\s*"(\w+)""#, &restart));
    let second = source(SECOND);
    keys.extend(firsts(r#"ranged\s*\(\s*time_\.controlDict\(\),\s*"(\w+)""#, &second));
    let output = source("openfoam/granularModels/granularState/granularStateOutput.C");
    keys.extend(firsts(r#"\bdict\.\w+(?:<\w+>)?\(\s*"(\w+)""#, &output));
    let control = Set::new(SYSTEM, "controlDict", "openfoam/**/*.C", keys).and(&OF_TIME);
    let literals = second.clone() + &restart + &source("openfoam/msddFoam/timeScheme/paperScheme.C");
    let msdd_foam = with_literals(msdd_foam, &(scheme + &second)).without(
        "temperatureTolerance",
        "default",
        "its 0 is a mark for 'not given'",
    );
    vec![msdd_foam, with_literals(control, &literals)]
}

fn beds() -> Vec<Set> {
    let set =
        Set::new(BEDS, "thermophysicalProperties of a bed", THERMO, allowed_keys(&source(THERMO), "*this"))
            .but(&[("FoamFile", "head of every file of OpenFOAM")]);
    let contact = source(CONTACT);
    let keys = firsts(r#"\bdict\.\w+(?:<\w+>)?\(\s*"(\w+)""#, &contact);
    let condition = Set::new(BEDS, "granularContact", CONTACT, keys);
    vec![with_literals(set, &source(AXES)), with_literals(condition, &contact)]
}

fn function_objects() -> Vec<Set> {
    let sources = all_sources();
    let types = selectable("functionObject", &sources);
    let base = Set {
        table: "all function objects".to_string(),
        page: OBJECTS,
        source: "OpenFOAM".to_string(),
        names: std::collections::BTreeMap::new(),
    };
    let mut sets = vec![
        Set::new(OBJECTS, "types of function objects", "openfoam/functionObjects", types.clone()),
        base.and(&OF_FUNCTION_OBJECTS),
    ];
    for name in types {
        let path = format!("openfoam/functionObjects/{name}/{name}.C");
        let text = source(&path);
        let keys = firsts(r#"\bdict\.\w+(?:<\w+>)?\(\s*"(\w+)""#, &text);
        if !keys.is_empty() {
            sets.push(with_literals(Set::new(OBJECTS, &name, &path, keys), &text));
        }
        sets.push(Set::new(OBJECTS, &format!("columns of {name}"), &path, columns(&text)));
    }
    sets
}

/// Names in the head of a function object's file; those that begin with the name of a patch or field as on the page.
fn columns(text: &str) -> Vec<String> {
    let head = sources::between(text, r"::writeHeader\([^)]*\) const\n\{", r"^\}", "a function object");
    let mut names = firsts(r#"write(?:Tabbed|Commented)\(os, "(\w+)"\)"#, &head);
    names.extend(
        firsts(r"(?s)const char\* column :\s*\{(.*?)\}", &head).iter().flat_map(|list| strings(list)),
    );
    names.extend(firsts(r#"patch\.name\(\) \+ "(\w+)""#, &head).iter().map(|end| format!("<patch>{end}")));
    names.extend(firsts(r#"region \+ "(\w+)""#, &head).iter().map(|end| format!("<region>{end}")));
    if head.contains("field_ + Foam::name(i)") {
        names.push("<field><number>".to_string());
    }
    names
}
