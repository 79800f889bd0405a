// SPDX-License-Identifier: MIT
// Taps of an a-trous iteration: KERNEL_RADIUS 2 is the 5x5 B3 spline of Schied et al. 2017,
// 1 the 3x3 box of the implementation in Schied et al. 2018. Five iterations with steps 1 to 16
// reach 125x125 and 63x63 pixels.

#if KERNEL_RADIUS == 2
const float kKernel[3] = float[](3.0 / 8.0, 1.0 / 4.0, 1.0 / 16.0);
#else
const float kKernel[2] = float[](1.0 / 3.0, 1.0 / 3.0);
#endif

float kernelWeight(int x, int y) {
    return kKernel[abs(x)] * kKernel[abs(y)];
}
