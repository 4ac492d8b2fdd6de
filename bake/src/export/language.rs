//! The languages that a lookup can be exported to.

use super::dialect::{self, Dialect};

/// A language, or the part of one that a program reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Language {
    /// WebGPU.
    Wgsl,
    /// OpenGL 3.3 and later, OpenGL ES 3.0, WebGL 2.
    Glsl,
    /// Direct3D, Unity, Unreal.
    Hlsl,
    /// Metal.
    Msl,
    /// Open Shading Language: a camera for Blender's Cycles.
    Osl,
    /// Godot 4.
    Gdshaderinc,
    /// A complete shader for shadertoy.com.
    Shadertoy,
    /// A JavaScript module for three.js, with the GLSL in it.
    Three,
    /// Python with numpy.
    Python,
    /// C99, also as C++.
    C,
}

impl Language {
    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Language::Wgsl => "wgsl",
            Language::Glsl => "glsl",
            Language::Hlsl => "hlsl",
            Language::Msl => "msl",
            Language::Osl => "osl",
            Language::Gdshaderinc => "gdshaderinc",
            Language::Shadertoy => "shadertoy",
            Language::Three => "three",
            Language::Python => "python",
            Language::C => "c",
        }
    }

    /// Extension of its files.
    pub fn extension(self) -> &'static str {
        match self {
            Language::Wgsl => "wgsl",
            Language::Glsl | Language::Shadertoy => "glsl",
            Language::Hlsl => "hlsl",
            Language::Msl => "metal",
            Language::Osl => "osl",
            Language::Gdshaderinc => "gdshaderinc",
            Language::Three => "js",
            Language::Python => "py",
            Language::C => "h",
        }
    }

    /// How it writes the functions; `None` for Python, whose text is its own.
    pub(super) fn dialect(self) -> Option<&'static Dialect> {
        match self {
            Language::Wgsl => Some(&dialect::WGSL),
            Language::Glsl | Language::Shadertoy | Language::Three => Some(&dialect::GLSL),
            Language::Hlsl => Some(&dialect::HLSL),
            Language::Msl => Some(&dialect::MSL),
            Language::Osl => Some(&dialect::OSL),
            Language::Gdshaderinc => Some(&dialect::GODOT),
            Language::C => Some(&dialect::C),
            Language::Python => None,
        }
    }

    /// What a line of a comment begins with.
    pub(super) fn comment(self) -> &'static str {
        match self {
            Language::Python => "#",
            _ => "//",
        }
    }
}
