// What Unity's compiler says before it reads its StdLib.hlsl.
#define SHADER_API_VULKAN 1
#define SHADER_TARGET 50
// Graphics cards of desktops compute halves in 32 bits.
#define half float
#define half2 float2
#define half3 float3
#define half4 float4
#include "../../../../StdLib.hlsl"
