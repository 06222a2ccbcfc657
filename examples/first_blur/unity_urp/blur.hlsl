// Colours averaged along the motion: the text between HLSLPROGRAM and ENDHLSL of a full-screen pass.
#include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Core.hlsl"
#include "Packages/com.unity.render-pipelines.core/Runtime/Utilities/Blit.hlsl"

TEXTURE2D_X(_MotionVectorTexture);
float _Intensity;
int _SampleCount;

half4 Frag(Varyings input) : SV_Target
{
    float2 motion = SAMPLE_TEXTURE2D_X(_MotionVectorTexture, sampler_PointClamp, input.texcoord).xy;
    float2 trail = motion * _Intensity;
    half4 sum = 0.0;
    for (int tap = 0; tap < _SampleCount; tap++)
    {
        float along = (tap + 0.5) / _SampleCount;
        sum += SAMPLE_TEXTURE2D_X(_BlitTexture, sampler_LinearClamp, input.texcoord + along * trail);
    }
    return sum / _SampleCount;
}
