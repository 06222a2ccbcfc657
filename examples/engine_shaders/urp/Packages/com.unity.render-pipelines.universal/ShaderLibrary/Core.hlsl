// What CameraMotionBlur.shader needs of the file of this name, in words of our own.
float4x4 unity_MatrixInvVP;
#define UNITY_MATRIX_I_VP unity_MatrixInvVP
