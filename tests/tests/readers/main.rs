//! OpenEXR files of this project, read by other programs: OpenEXR's own library, tinyexr and three.js.

mod pictures;
mod programs;
mod tables;
