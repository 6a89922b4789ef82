// Eigen's Fourier transforms, by FFTW; its plans do not depend on what a measurement gave.
#pragma once

#define EIGEN_FFTW_DEFAULT
#include <unsupported/Eigen/FFT>
