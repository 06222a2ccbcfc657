// The parts that this blur needs of URP's file of this name, in our own words, for one eye.
#define TEXTURE2D_X(name) Texture2D<float4> name
#define SAMPLER(name) SamplerState name
#define SAMPLE_TEXTURE2D_X(name, sampling, uv) name.SampleLevel(sampling, uv, 0.0)

SAMPLER(sampler_LinearClamp);
SAMPLER(sampler_PointClamp);
