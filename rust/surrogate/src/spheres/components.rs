//! Arrays of components.

/// An array of so many components. Closures would not always be compiled for the instruction set of their caller.
macro_rules! six {
    ($k:ident => $of:expr) => {
        six!([0 1 2 3 4 5] $k => $of)
    };
    ([$($number:literal)*] $k:ident => $of:expr) => {
        [$({
            let $k: usize = $number;
            $of
        }),*]
    };
}
macro_rules! three {
    ($k:ident => $of:expr) => {
        $crate::spheres::components::six!([0 1 2] $k => $of)
    };
}
pub(super) use {six, three};
