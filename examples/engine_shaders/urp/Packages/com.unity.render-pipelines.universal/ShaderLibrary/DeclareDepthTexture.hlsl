// What CameraMotionBlur.shader needs of the file of this name, in words of our own.
TEXTURE2D_X(_CameraDepthTexture);
float SampleSceneDepth(float2 uv)
{
    return SAMPLE_TEXTURE2D_X(_CameraDepthTexture, sampler_PointClamp, uv).r;
}
