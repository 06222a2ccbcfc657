// What this blur needs of URP's file of this name, in words of our own, for one eye.
#define TEXTURE2D_X(name) Texture2D<float4> name
#define SAMPLER(name) SamplerState name
#define SAMPLE_TEXTURE2D_X(name, sampling, uv) name.SampleLevel(sampling, uv, 0.0)

SAMPLER(sampler_LinearClamp);
SAMPLER(sampler_PointClamp);
