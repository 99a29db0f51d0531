//! What is known of a mesh, whether `constant/polyMesh` or `system/blockMeshDict` says it.

use crate::dictionary::{Dictionary, Entry};

/// Path in the case folder.
pub const BLOCKS: &str = "system/blockMeshDict";

/// Properties of the mesh that other checks need.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Names of the patches with their types; empty when they are not known.
    pub patches: Vec<[String; 2]>,
    /// Groups of patches, and a patch in each of them.
    pub groups: Vec<[String; 2]>,
    /// Names of the patches that have no faces.
    pub bare: Vec<String>,
    /// Number of cells.
    pub cells: Option<usize>,
    /// Number of cells along x and y, if the mesh is a single block.
    pub shape: Option<[usize; 2]>,
    /// Lower left and upper right corner of the box [m].
    pub bounds: Option<[[f64; 2]; 2]>,
    /// Least and greatest coordinates of its points [m].
    pub extent: Option<[[f64; 3]; 2]>,
    /// Of a wedge, the directions of its axis and of the normal of its middle plane, 0 for x.
    pub axis: Option<[usize; 2]>,
    /// Plane sides of the mesh; none when they are not known.
    pub sides: Option<Vec<Side>>,
    /// Names of the zones of cells; none when they are not known.
    pub zones: Option<Vec<String>>,
    /// Names of the sets of cells and faces; none when they are not known.
    pub sets: Option<Vec<String>>,
}

/// A plane side of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Side {
    /// Its patch; none if it is in that of type `empty` that OpenFOAM makes of what is left.
    pub patch: Option<String>,
    /// Of length 1.
    pub normal: [f64; 3],
}

/// What a cell is, which the types of the patches say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// One layer in the plane of x and y.
    Plane,
    /// A body of revolution.
    Wedge,
    Solid,
    Unknown,
}

impl Mesh {
    /// Names of the patches.
    pub fn names(&self) -> Vec<String> {
        self.patches.iter().map(|[name, _]| name.clone()).collect()
    }

    /// Takes over patches, with their groups.
    pub fn take(&mut self, patches: Vec<Patch>) {
        let groups = |patch: &Patch| {
            let name = patch.name.clone();
            patch.groups.clone().into_iter().map(move |group| [group, name.clone()])
        };
        self.groups = patches.iter().flat_map(groups).collect();
        self.bare = patches.iter().filter(|patch| !patch.has_faces).map(|patch| patch.name.clone()).collect();
        self.patches = patches.into_iter().map(|patch| [patch.name, patch.kind]).collect();
    }

    /// The condition of a patch in `boundaryField` of a field: that of its name, else of the last of its groups, else of a pattern.
    pub fn condition<'a>(&self, boundary: &'a Dictionary, patch: &str) -> Option<&'a Entry> {
        let is_group = |key: &str| self.groups.iter().any(|[group, one]| group == key && one == patch);
        let group = || boundary.keys().filter(|key| !key.quoted && is_group(&key.text)).last();
        let named = boundary.get(patch).or_else(|| boundary.get(&group()?.text));
        named.or_else(|| boundary.matching(patch))
    }

    pub fn kind(&self) -> Kind {
        // OpenFOAM does not count patches without faces
        let patches = self.patches.iter().filter(|[name, _]| !self.bare.contains(name));
        let has = |kind: &str| patches.clone().any(|[_, other]| other == kind);
        match (has("wedge"), has("empty")) {
            (true, _) => Kind::Wedge,
            (false, true) => Kind::Plane,
            (false, false) if self.patches.is_empty() => Kind::Unknown,
            (false, false) => Kind::Solid,
        }
    }

    /// Whether it may have one layer of cells along z; that it has more is said apart.
    pub fn is_one_layer(&self) -> bool {
        self.shape.is_some() || self.cells.is_none() || self.bounds.is_none()
    }

    /// Sides of a cell [m], if all cells are equal.
    pub fn cell(&self) -> Option<[f64; 2]> {
        let ([low, high], [nx, ny]) = (self.bounds?, self.shape?);
        Some([(high[0] - low[0]) / nx as f64, (high[1] - low[1]) / ny as f64])
    }
}

/// A patch as the mesh or `blockMeshDict` gives it.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    pub name: String,
    kind: String,
    groups: Vec<String>,
    has_faces: bool,
}

/// Patches in `( name { type t; ... } ... )`.
pub fn patches_in(words: &[&str]) -> Vec<Patch> {
    let mut patches = Vec::new();
    for (k, pair) in words.windows(2).enumerate() {
        if pair[1] != "{" {
            continue;
        }
        let inside = &words[k + 2..];
        let inside = &inside[..inside.iter().position(|&word| word == "}").unwrap_or(inside.len())];
        let value = |key: &str| {
            let from = inside.iter().position(|&word| word == key)? + 1;
            inside[from..].split(|&word| word == ";").next()
        };
        let kind = value("type").and_then(|words| words.first()).map_or("", |word| word);
        let is_name = |word: &&str| !["(", ")"].contains(word) && !word.starts_with("List<");
        let mut groups: Vec<&str> =
            value("inGroups").unwrap_or_default().iter().copied().filter(is_name).collect();
        groups.retain(|word| word.parse::<usize>().is_err());
        // Those which OpenFOAM gives to patches by itself
        match kind {
            "patch" => {}
            "mappedWall" => groups.extend([kind, "wall"]),
            _ => groups.push(kind),
        }
        // Their number in the mesh, the faces themselves in blockMeshDict
        let has_faces = match (value("nFaces"), value("faces")) {
            (Some(count), _) => count != ["0"],
            (None, Some(faces)) => faces.iter().skip(1).any(|word| word.parse::<usize>().is_ok()),
            (None, None) => true,
        };
        let groups = groups.into_iter().map(str::to_string).collect();
        patches.push(Patch { name: pair[0].to_string(), kind: kind.to_string(), groups, has_faces });
    }
    patches
}
