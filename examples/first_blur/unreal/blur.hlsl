// Colours averaged along the motion.
#include "Common.ush"

Texture2D SceneColorTexture;
SamplerState SceneColorSampler;
Texture2D SceneVelocityTexture;
RWTexture2D<float4> OutputTexture;
float2 ViewportSize;
float Exposure;
int SampleCount;

[numthreads(THREADGROUP_SIZE, THREADGROUP_SIZE, 1)]
void MainCS(uint3 DispatchThreadId : SV_DispatchThreadID)
{
    if (any(DispatchThreadId.xy >= uint2(ViewportSize)))
        return;
    float2 ViewportUV = (DispatchThreadId.xy + 0.5) / ViewportSize;
    float2 Velocity = DecodeVelocityFromTexture(SceneVelocityTexture.Load(int3(DispatchThreadId.xy, 0)));
    float2 Trail = Velocity * float2(0.5, -0.5) * Exposure;
    float4 Sum = 0.0;
    for (int Tap = 0; Tap < SampleCount; Tap++)
    {
        float Along = (Tap + 0.5) / SampleCount;
        Sum += SceneColorTexture.SampleLevel(SceneColorSampler, ViewportUV + Along * Trail, 0.0);
    }
    OutputTexture[DispatchThreadId.xy] = Sum / SampleCount;
}
