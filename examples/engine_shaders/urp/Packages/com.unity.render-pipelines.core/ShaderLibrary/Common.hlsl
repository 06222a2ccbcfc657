// What CameraMotionBlur.shader needs of the file of this name, in words of our own.
#define UNITY_REVERSED_Z 1
#define UNITY_UV_STARTS_AT_TOP 1
#define UNITY_NEAR_CLIP_VALUE 1.0
#define UNITY_UNROLL [unroll]
#define half float
#define half2 float2
#define half3 float3
#define half4 float4
#define TEXTURE2D_X(name) Texture2D<float4> name
#define SAMPLE_TEXTURE2D_X(name, sampling, uv) name.SampleLevel(sampling, uv, 0.0)

// One eye.
#define UNITY_VERTEX_INPUT_INSTANCE_ID
#define UNITY_VERTEX_OUTPUT_STEREO
#define UNITY_SETUP_INSTANCE_ID(input)
#define UNITY_INITIALIZE_VERTEX_OUTPUT_STEREO(output)
#define UNITY_SETUP_STEREO_EYE_INDEX_POST_VERTEX(input)
#define UnityStereoTransformScreenSpaceTex(uv) uv

float4 GetFullScreenTriangleVertexPosition(uint vertexID)
{
    float2 corner = float2((vertexID << 1) & 2, vertexID & 2);
    return float4(corner * 2.0 - 1.0, UNITY_NEAR_CLIP_VALUE, 1.0);
}

float2 GetFullScreenTriangleTexCoord(uint vertexID)
{
    return float2((vertexID << 1) & 2, 1.0 - (vertexID & 2));
}

float3 ComputeWorldSpacePosition(float2 uv, float depth, float4x4 inverseViewProjection)
{
    float4 clip = float4(uv.x * 2.0 - 1.0, 1.0 - uv.y * 2.0, depth, 1.0);
    float4 world = mul(inverseViewProjection, clip);
    return world.xyz / world.w;
}
