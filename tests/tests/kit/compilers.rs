//! The texts in GLSL and HLSL: compiled by Khronos' reference compiler.

use lensbake_test_support::workspace;
use std::process::Command;
use tempfile::TempDir;

const ROW: &str = "lensbake(d, hole, r, data)";
const ONE: &str = "lensbake_r10(d, hole)";
const SIMPLE: &str = "lensbake_simple(d, hole, r, data)";
const SIMPLE_16: &str = "lensbake_simple16(d, hole, r, data)";

const GLSL: [(&str, &str); 4] = [
    ("glsl/lensbake.glsl", ROW),
    ("glsl/lensbake_r10.glsl", ONE),
    ("glsl/lensbake_simple.glsl", SIMPLE),
    ("glsl/lensbake_simple16.glsl", SIMPLE_16),
];

const HLSL: [(&str, &str); 3] = [
    ("hlsl/lensbake.hlsl", ROW),
    ("hlsl/lensbake_r10.hlsl", ONE),
    (
        "hlsl/lensbake_simple.hlsl",
        "lensbake_simple(d, hole, r, data, linear_clamp)",
    ),
];

const ES_300: &str = "#version 300 es
precision highp float;
in vec3 d;
uniform vec3 hole;
uniform float r;
uniform highp sampler2D data;
out vec4 colour;
";
const CORE_450: &str = "#version 450
layout(location = 0) in vec3 d;
layout(location = 0) out vec4 colour;
layout(location = 0) uniform vec3 hole;
layout(location = 1) uniform float r;
layout(binding = 0) uniform sampler2D data;
";
const DIRECT3D: &str = "float3 hole; float r; Texture2D data; SamplerState linear_clamp;\n";

fn compile(name: &str, source: &str, options: &[&str]) {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, source).unwrap();
    let output = Command::new("glslangValidator")
        .args(options)
        .arg(&path)
        .current_dir(folder.path())
        .output()
        .unwrap_or_else(|e| panic!("glslangValidator: {e}: {}", super::HINT));
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{name}: {said}");
    assert!(!said.to_lowercase().contains("warning"), "{name}: {said}");
}

fn text(file: &str) -> String {
    std::fs::read_to_string(workspace().join("kit").join(file)).unwrap()
}

#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn glsl_compiles_as_es_300_and_as_450() {
    for (file, call) in GLSL {
        for before in [ES_300, CORE_450] {
            // Included twice: the guard must hold.
            let text = text(file).repeat(2);
            let source = format!("{before}{text}void main() {{ colour = vec4({call}, 1.0); }}\n");
            compile("shader.frag", &source, &[]);
        }
    }
}

#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn hlsl_compiles() {
    for (file, call) in HLSL {
        let text = text(file).repeat(2);
        let main = format!(
            "float4 main(float3 d : TEXCOORD0) : SV_Target {{ return float4({call}, 1.0); }}\n"
        );
        let options = ["-D", "-V", "-S", "frag", "-e", "main", "-o", "shader.spv"];
        compile("shader.hlsl", &format!("{DIRECT3D}{text}{main}"), &options);
    }
}

/// What Unity declares before the file of a Custom Function node, and the calls that it generates.
const UNITY: [&str; 2] = [
    "struct UnityTexture2D { Texture2D tex; SamplerState samplerstate; };
Texture2D texture0;
SamplerState sampler0;
float3 hole;
float r;
",
    "float4 main(float3 d : TEXCOORD0) : SV_Target {
    UnityTexture2D atlas;
    atlas.tex = texture0;
    atlas.samplerstate = sampler0;
    float3 sky;
    float visible;
    Lensbake_float(d, hole, r, atlas, sky, visible);
    half3 half_sky;
    half half_visible;
    Lensbake_half(half3(d), half3(hole), half(r), atlas, half_sky, half_visible);
    return float4(sky + float3(half_sky), visible + float(half_visible));
}
",
];

#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn the_node_for_unity_compiles() {
    let [before, main] = UNITY;
    let source = format!("{before}{}{main}", text("unity/LensbakeNode.hlsl"));
    let include = format!("-I{}", workspace().join("kit/unity").display());
    let options = [
        "-D",
        "-V",
        "-S",
        "frag",
        "-e",
        "main",
        "-o",
        "shader.spv",
        &include,
    ];
    compile("shader.hlsl", &source, &options);
}

/// The texts for Unity and Unreal are the one that is run.
#[test]
fn the_texts_for_unity_and_unreal_are_that_of_hlsl() {
    let code = |file: &str| {
        let text = text(file)
            .replace("lensbake_simple", "lensbake")
            .replace("LENSBAKE_SIMPLE", "LENSBAKE");
        let (_, code) = text.split_once("#ifndef").unwrap();
        code.to_owned()
    };
    for file in ["unity/lensbake.hlsl", "unreal/lensbake.ush"] {
        assert_eq!(code(file), code("hlsl/lensbake_simple.hlsl"), "{file}");
    }
}
