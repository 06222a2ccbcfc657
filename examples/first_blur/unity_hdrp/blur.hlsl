// Colours averaged along the motion.
#pragma kernel MotionBlurCS
#include "Packages/com.unity.render-pipelines.high-definition/Runtime/ShaderLibrary/ShaderVariables.hlsl"

TEXTURE2D_X(_InputTexture);
RW_TEXTURE2D_X(float4, _OutputTexture);
float _Intensity;
int _SampleCount;

[numthreads(8, 8, 1)]
void MotionBlurCS(uint3 id : SV_DispatchThreadID)
{
    UNITY_XR_ASSIGN_VIEW_INDEX(id.z);
    if (any(id.xy >= uint2(_PostProcessScreenSize.xy)))
        return;
    float2 uv = (id.xy + 0.5) * _PostProcessScreenSize.zw;
    float2 trail = LOAD_TEXTURE2D_X(_CameraMotionVectorsTexture, id.xy).xy * _Intensity;
    float4 sum = 0.0;
    for (int tap = 0; tap < _SampleCount; tap++)
    {
        float along = (tap + 0.5) / _SampleCount;
        sum += SAMPLE_TEXTURE2D_X_LOD(_InputTexture, s_linear_clamp_sampler, uv + along * trail, 0);
    }
    _OutputTexture[COORD_TEXTURE2D_X(id.xy)] = sum / _SampleCount;
}
