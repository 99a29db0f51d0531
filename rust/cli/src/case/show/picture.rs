//! A picture as PNG.

use crate::error::CliError;
use resvg::{tiny_skia, usvg};

/// Pixels of a PNG for each of the picture.
const FINE: f32 = 2.0;
/// Families that are looked for as the one without serifs.
const FONTS: [&str; 4] = ["DejaVu Sans", "Liberation Sans", "Noto Sans", "Arial"];

/// The picture in pixels.
pub fn png(svg: &str) -> Result<Vec<u8>, CliError> {
    let failed = |problem: String| CliError::Message(format!("cannot draw the PNG: {problem}"));
    let mut options = usvg::Options::default();
    let fonts = options.fontdb_mut();
    fonts.load_system_fonts();
    let there =
        |name: &&&str| fonts.faces().any(|face| face.families.iter().any(|family| family.0 == ***name));
    let first = fonts.faces().next().and_then(|face| Some(face.families.first()?.0.clone()));
    let Some(family) = FONTS.iter().find(there).map(|name| (*name).to_string()).or(first) else {
        return Err(failed(
            "there is no font; install one, such as the package fonts-dejavu-core, or use --svg".into(),
        ));
    };
    fonts.set_sans_serif_family(family);
    let tree = usvg::Tree::from_str(svg, &options).map_err(|error| failed(error.to_string()))?;
    let size = tree.size().to_int_size().scale_by(FINE).ok_or_else(|| failed("no size".into()))?;
    let mut pixels = tiny_skia::Pixmap::new(size.width(), size.height())
        .ok_or_else(|| failed("it is too large".into()))?;
    resvg::render(&tree, tiny_skia::Transform::from_scale(FINE, FINE), &mut pixels.as_mut());
    pixels.encode_png().map_err(|error| failed(error.to_string()))
}
