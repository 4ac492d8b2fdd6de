// The lookup as a Custom Function node of Unity's Shader Graph: Type File, Source this file, Name Lensbake. Inputs: Direction
// (Vector 3), Hole (Vector 3), Radius (Float), Atlas (Texture 2D). Outputs: Sky (Vector 3), Visible (Float).

#ifndef LENSBAKE_NODE_INCLUDED
#define LENSBAKE_NODE_INCLUDED

#include "lensbake.hlsl"

void Lensbake_float(
    float3 Direction, float3 Hole, float Radius, UnityTexture2D Atlas, out float3 Sky, out float Visible)
{
    Sky = lensbake(normalize(Direction), normalize(Hole), Radius, Atlas.tex, Atlas.samplerstate);
    Visible = step(0.5, dot(Sky, Sky));
}

// Half precision is too coarse for directions: the node computes in single precision whatever the graph asks for.
void Lensbake_half(
    half3 Direction, half3 Hole, half Radius, UnityTexture2D Atlas, out half3 Sky, out half Visible)
{
    float3 sky;
    float visible;
    Lensbake_float(Direction, Hole, Radius, Atlas, sky, visible);
    Sky = half3(sky);
    Visible = half(visible);
}

#endif
