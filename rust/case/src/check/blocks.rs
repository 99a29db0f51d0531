//! Reads `system/blockMeshDict`, the description of a mesh that blockMesh makes.

use super::domain::{BLOCKS as FILE, Mesh, Patch, patches_in};
use super::finding::Findings;
use super::{held, made};
use crate::dictionary::{Dictionary, Token};

/// Reads what the dictionary says of the mesh that blockMesh will make.
pub fn read(blocks: &Dictionary, is_plane: bool, mesh: &mut Mesh, found: &mut Findings) {
    mesh.bounds = crate::case::bounds(blocks).ok().map(|(low, high)| [low, high]);
    if let Some(corners) = crate::case::corners(blocks) {
        mesh.extent = Some(made::extent_of(&corners));
        mesh.axis = axis_of_wedge(blocks, &corners);
        mesh.sides = held::sides(blocks, &corners);
    }
    match blocks.value("blocks") {
        Ok(tokens) => {
            let numbers = cells_in(tokens);
            mesh.cells = (!numbers.is_empty()).then(|| numbers.iter().map(|[x, y, z]| x * y * z).sum());
            if let [[nx, ny, nz]] = numbers[..] {
                mesh.shape = (nz == 1).then_some([nx, ny]);
                if nz != 1 && is_plane {
                    let advice = "This model is two-dimensional: one cell in z, with patches of type empty in front and behind; the surrogate types spheres and constant take any mesh";
                    found.error([FILE, "blocks"], &format!("( {nx} {ny} {nz} )"), "one cell along z", advice);
                }
            }
        }
        Err(error) => found.refused(FILE, error, ""),
    }
    mesh.take(patches_of_blocks(blocks));
}

/// The numbers of cells in each `hex ( ... ) ( nx ny nz )`, also with the name of a zone in between.
fn cells_in(tokens: &[Token]) -> Vec<[usize; 3]> {
    let after = |block: &[Token]| {
        let end = block.iter().position(|token| token.text == ")")?;
        let open = end + block[end..].iter().position(|token| token.text == "(")?;
        let numbers = block.get(open + 1..open + 4)?.iter().map(|token| token.text.parse().ok());
        <[usize; 3]>::try_from(numbers.collect::<Option<Vec<_>>>()?).ok()
    };
    tokens.split(|token| token.text == "hex").skip(1).filter_map(after).collect()
}

/// Patches in `boundary ( name { type t; faces (...); } ... )`.
fn patches_of_blocks(blocks: &Dictionary) -> Vec<Patch> {
    let Ok(tokens) = blocks.value("boundary") else { return Vec::new() };
    let words: Vec<&str> = tokens.iter().map(|token| token.text.as_str()).collect();
    patches_in(&words)
}

/// Axis and normal of the first patch of type wedge, as OpenFOAM finds them: the middle plane is normal to the coordinate that is nearest
/// to the patch's normal, and the axis is at right angles to both.
fn axis_of_wedge(blocks: &Dictionary, corners: &[[f64; 3]]) -> Option<[usize; 2]> {
    let tokens = blocks.value("boundary").ok()?;
    let words: Vec<&str> = tokens.iter().map(|token| token.text.as_str()).collect();
    let wedge = words.windows(2).position(|pair| pair == ["type", "wedge"])?;
    let open = words[..wedge].iter().rposition(|&word| word == "{")?;
    let inside = &words[open..];
    let inside = &inside[..inside.iter().position(|&word| word == "}")?];
    let faces = inside.iter().position(|&word| word == "faces")?;
    let face = inside[faces..].iter().skip_while(|word| word.parse::<usize>().is_err());
    let face: Vec<[f64; 3]> =
        face.map_while(|word| word.parse::<usize>().ok()).map_while(|k| corners.get(k).copied()).collect();
    let mut normal = [0.0; 3];
    for (k, a) in face.iter().enumerate() {
        let b = face[(k + 1) % face.len()];
        for (i, part) in normal.iter_mut().enumerate() {
            let (j, l) = ((i + 1) % 3, (i + 2) % 3);
            *part += a[j] * b[l] - a[l] * b[j];
        }
    }
    let size = |k: &usize| normal[*k].abs();
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| size(a).total_cmp(&size(b)));
    let [axis, side, across] = order;
    (size(&side) > 0.0 && size(&axis) <= 1e-6 * size(&side)).then_some([axis, across])
}
