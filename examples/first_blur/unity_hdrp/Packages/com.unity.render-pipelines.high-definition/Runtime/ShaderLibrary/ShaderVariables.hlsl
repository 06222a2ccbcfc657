// The parts that this blur needs of HDRP's file of this name and of its includes, in our own words, for one eye.
#define TEXTURE2D_X(name) Texture2D<float4> name
#define RW_TEXTURE2D_X(type, name) RWTexture2D<type> name
#define COORD_TEXTURE2D_X(pixel) pixel
#define LOAD_TEXTURE2D_X(name, pixel) name.Load(int3(pixel, 0))
#define SAMPLE_TEXTURE2D_X_LOD(name, sampling, uv, level) name.SampleLevel(sampling, uv, level)
#define UNITY_XR_ASSIGN_VIEW_INDEX(index)

SamplerState s_linear_clamp_sampler;
TEXTURE2D_X(_CameraMotionVectorsTexture);
float4 _PostProcessScreenSize;
