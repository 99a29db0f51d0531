//! New cases of beds of equal spheres with gas between them.
//!
//! | module | what |
//! |---|---|
//! | [`material`] | named materials |
//! | [`blocks`] | the mesh |
//! | [`shape`] | boxes and cylinders, their walls, cells and points |
//! | [`scene`] | the parameters of a new case |
//! | [`start`] | what the law of spheres says of the bed at the start |
//! | [`wall`] | the friction of walls |
//! | [`folder`] | the files of a new case |

pub mod blocks;
pub mod folder;
pub mod material;
pub mod scene;
pub mod shape;
pub mod start;
pub mod wall;
