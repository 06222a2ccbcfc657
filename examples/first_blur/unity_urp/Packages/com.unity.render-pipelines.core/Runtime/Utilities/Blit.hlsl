// The parts that this blur needs of the file of this name, in our own words.
TEXTURE2D_X(_BlitTexture);

struct Varyings
{
    float4 positionCS : SV_POSITION;
    float2 texcoord : TEXCOORD0;
};
