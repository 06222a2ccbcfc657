// What KinoMotion uses of Unity's UnityCG.cginc, under the same names. Unity's own file is not needed.
#define UNITY_PI 3.14159265359f
#define UNITY_LOOP [loop]

// Graphics cards of desktops compute halves in 32 bits.
#define half float
#define half2 float2
#define half3 float3
#define half4 float4

// Textures with a sampler each, as Direct3D 9 had them. A texture `_Name` has the sampler `sampler_Name`.
#define sampler2D Texture2D<float4>
#define sampler2D_float Texture2D<float4>
#define sampler2D_half Texture2D<float4>
SamplerState sampler_MainTex;
SamplerState sampler_CameraDepthTexture;
SamplerState sampler_CameraMotionVectorsTexture;
SamplerState sampler_VelocityTex;
SamplerState sampler_NeighborMaxTex;

// Every texture has one mip level.
#define tex2D(image, uv) image.SampleLevel(sampler##image, uv, 0.0)
#define tex2Dlod(image, uv) image.SampleLevel(sampler##image, (uv).xy, 0.0)
#define SAMPLE_DEPTH_TEXTURE(image, uv) tex2D(image, uv).r

// What Unity sets in every frame.
float4 _Time;
float4 _ScreenParams;
float4 _ZBufferParams;
float4 unity_OrthoParams;

struct appdata_full
{
    float4 vertex : POSITION;
    float4 texcoord : TEXCOORD0;
};

struct v2f_img
{
    float4 pos : SV_POSITION;
    float2 uv : TEXCOORD0;
};

float4 UnityObjectToClipPos(float4 position)
{
    return position;
}
