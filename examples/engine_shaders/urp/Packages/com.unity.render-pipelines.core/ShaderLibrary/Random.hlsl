// Interleaved gradient noise (Jimenez 2014), under Unity's name, for frame 0.
float InterleavedGradientNoise(float2 pixel, int frame)
{
    return frac(52.9829189 * frac(dot(pixel, float2(0.06711056, 0.00583715))));
}
