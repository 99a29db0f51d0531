//! Files of OpenFOAM whose lists are written in binary, as its programs write them with `writeFormat binary`.

use flate2::read::GzDecoder;
use std::fmt::Write;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Kinds of lists of numbers, and how many numbers an entry has.
const LISTS: [(&str, usize); 5] =
    [("scalar", 1), ("vector", 3), ("sphericalTensor", 1), ("symmTensor", 6), ("tensor", 9)];

/// The text of a file with binary lists, also of one that is packed; none for other files.
pub fn text_of(file: &Path) -> Option<String> {
    let bytes = read(file)?;
    (is_binary(&bytes) && find(&bytes, b"List<").is_some()).then(|| as_text(&bytes)).flatten()
}

/// The bytes of a file, or those of the packed file next to it.
pub fn read(file: &Path) -> Option<Vec<u8>> {
    let packed = file.with_file_name(format!("{}.gz", file.file_name()?.to_str()?));
    let limit = msdd_files::MAX_BYTES;
    let mut bytes = Vec::new();
    match File::open(file) {
        Ok(open) => open.take(limit).read_to_end(&mut bytes).ok()?,
        Err(_) => GzDecoder::new(File::open(packed).ok()?).take(limit).read_to_end(&mut bytes).ok()?,
    };
    Some(bytes)
}

/// The head of a file, up to its first closing brace.
pub fn head(file: &[u8]) -> String {
    let end = file.iter().position(|&byte| byte == b'}').unwrap_or(file.len());
    String::from_utf8_lossy(&file[..end]).to_string()
}

/// Whether the head of a file says that it is binary.
pub fn is_binary(file: &[u8]) -> bool {
    head(file).split_whitespace().any(|word| word == "binary;")
}

/// The text of a binary file, with its lists of numbers as text; none where a list is of another kind or cut off.
fn as_text(file: &[u8]) -> Option<String> {
    let size = if head(file).contains("scalar=32") { 4 } else { 8 };
    let (mut text, mut rest) = (String::new(), file);
    while let Some(at) = find(rest, b"List<") {
        let close = at + rest[at..].iter().position(|&byte| byte == b'>')?;
        let (_, count) = LISTS.iter().find(|(name, _)| rest[at + 5..close] == *name.as_bytes())?;
        text += std::str::from_utf8(&rest[..=close]).ok()?;
        rest = &rest[close + 1..];
        // The number of entries; an empty list has no bytes after it
        let end = rest.iter().position(|byte| !byte.is_ascii_whitespace() && !byte.is_ascii_digit())?;
        let length: usize = std::str::from_utf8(&rest[..end]).ok()?.trim().parse().ok()?;
        write!(text, " {length} (").ok()?;
        rest = &rest[end..];
        if rest.first() == Some(&b'(') {
            let bytes = rest.get(1..1 + length.checked_mul(count * size)?)?;
            for number in bytes.chunks_exact(size) {
                match number.try_into() {
                    Ok(number) => write!(text, " {:e}", f64::from_le_bytes(number)).ok()?,
                    Err(_) => write!(text, " {:e}", f32::from_le_bytes(number.try_into().ok()?)).ok()?,
                }
            }
            rest = rest.get(1 + bytes.len()..)?.strip_prefix(b")")?;
        }
        text += " )";
    }
    text += std::str::from_utf8(rest).ok()?;
    Some(text)
}

fn find(bytes: &[u8], word: &[u8]) -> Option<usize> {
    bytes.windows(word.len()).position(|part| part == word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_numbers_become_text() {
        let head =
            b"FoamFile { format binary; arch \"LSB;label=32;scalar=64\"; }\na nonuniform List<scalar> \n2\n(";
        let values = [300.0_f64, -0.5].map(f64::to_le_bytes).concat();
        let file = [head, &values[..], b");\nb nonuniform List<symmTensor> 0;\nc uniform 3;\n"].concat();
        assert!(is_binary(&file) && !is_binary(b"FoamFile { format ascii; } // binary;"));
        let text = as_text(&file).unwrap();
        let lists = "a nonuniform List<scalar> 2 ( 3e2 -5e-1 );\nb nonuniform List<symmTensor> 0 ( );\nc uniform 3;\n";
        assert!(text.ends_with(lists), "{text}");
        assert_eq!(as_text(&file[..head.len() + 9]), None);
        let single = [b"arch \"scalar=32\"; } a List<scalar> 1(", &2.5_f32.to_le_bytes()[..], b");"].concat();
        assert!(as_text(&single).unwrap().contains("1 ( 2.5e0 )"));
    }
}
