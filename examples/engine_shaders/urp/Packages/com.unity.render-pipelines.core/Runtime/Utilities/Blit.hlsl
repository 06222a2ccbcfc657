// What CameraMotionBlur.shader needs of the file of this name, in words of our own.
TEXTURE2D_X(_BlitTexture);
SamplerState sampler_PointClamp;
SamplerState sampler_LinearClamp;
float4 _BlitScaleBias;
#define DYNAMIC_SCALING_APPLY_SCALEBIAS(uv) ((uv) * _BlitScaleBias.xy + _BlitScaleBias.zw)

struct Attributes
{
    uint vertexID : SV_VertexID;
};
