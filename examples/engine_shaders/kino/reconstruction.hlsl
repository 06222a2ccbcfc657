// The program of pass 5 of Reconstruction.shader.
#include "Reconstruction.cginc"
