// Colours averaged along the motion. The first lines declare what UnityCG.cginc would.
Texture2D<float4> _MainTex;
SamplerState sampler_MainTex;
Texture2D<float4> _CameraMotionVectorsTexture;
SamplerState sampler_CameraMotionVectorsTexture;
float _ShutterAngle;
int _SampleCount;

struct v2f
{
    float4 pos : SV_POSITION;
    float2 uv : TEXCOORD0;
};

float4 frag(v2f i) : SV_Target
{
    float2 motion = _CameraMotionVectorsTexture.SampleLevel(sampler_CameraMotionVectorsTexture, i.uv, 0.0).xy;
    float2 trail = motion * _ShutterAngle / 360.0;
    float4 sum = 0.0;
    for (int tap = 0; tap < _SampleCount; tap++)
    {
        float along = (tap + 0.5) / _SampleCount;
        sum += _MainTex.SampleLevel(sampler_MainTex, i.uv + along * trail, 0.0);
    }
    return sum / _SampleCount;
}
