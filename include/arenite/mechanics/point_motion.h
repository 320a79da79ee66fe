#pragma once

#include <arenite/base/tensor_tools.h>
#include <arenite/mechanics/elastic_element.h>

#include <string>

namespace Arenite
{
/// `set Kinematics` and `set Objective rate` of a scene.
struct KinematicsChoice
{
  std::string kinematics = "small strain", rate = "Jaumann";

  void declare_parameters(Parameters &);

  bool finite_strain() const { return kinematics == "finite strain"; }
  bool polar() const { return rate == "Green-Naghdi"; }
};

/// How a point moves over a step, from the displacement gradients H at its end and dH of its increment, with the hoop strains h, dh.
///
/// Small strain: d eps = sym(dH), J = 1 + tr H, no rotation.
///
/// Finite strain, total Lagrangian: F = I + H and the midpoint F_m = F - dH/2 give G = dH F_m^-1 = D + W. Strain increments are
/// logarithmic, D + D^3/12 + D^5/80 (the series of 2 atanh(D/2), exact for a pure stretch up to (D^7)/448), with a trace that is ln(J/J_n)
/// to the last bit, so that strain and density cannot drift apart. The stress turns by the incremental rotation
///
///   Jaumann        Q = (I - W/2)^-1 (I + W/2)               Hughes & Winget, Int. J. Numer. Meth. Eng. 15 (1980) 1862-1867
///   Green-Naghdi   Q = R R_n^T with the polar factor R of F
///
/// and the strain increment, which belongs to the middle of the step, by the square root of Q: second order in the step.
template <int dim, int n_hoop, typename V>
struct PointMotion
{
  SymTensor<V> strain; ///< increment, in the frame at the end of the step
  V            J_old = V(1.), J = V(1.);
  V            Q[dim][dim]; ///< turns tensors of t_n; not set at small strain

  ARENITE_INLINE void small_strain(const V (&H)[dim][dim], const V (&dH)[dim][dim], const V &h, const V &dh)
  {
    set_strain(dH);
    J           = V(1.);
    V increment = V(0.);
    for (int i = 0; i < dim; ++i)
      {
        J += H[i][i];
        increment += dH[i][i];
      }
    for (int i = dim; i < dim + n_hoop; ++i)
      {
        strain[i] = dh;
        J += h;
        increment += dh;
      }
    J_old = J - increment;
  }

  ARENITE_INLINE void finite_strain(const V (&H)[dim][dim], const V (&dH)[dim][dim], const V &h, const V &dh,
                                    const bool polar)
  {
    V F[dim][dim], F_old[dim][dim], F_mid[dim][dim], C[dim][dim];
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        {
          F[i][j]     = H[i][j] + V(i == j ? 1. : 0.);
          F_old[i][j] = F[i][j] - dH[i][j];
          F_mid[i][j] = F[i][j] - V(0.5) * dH[i][j];
        }
    J     = cofactors(F, C);
    J_old = cofactors(F_old, C);
    for (int i = 0; i < n_hoop; ++i)
      {
        J *= V(1.) + h;
        J_old *= V(1.) + h - dh;
      }
    const V inverse = V(1.) / cofactors(F_mid, C);
    V       G[dim][dim], D[dim][dim];
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        {
          V sum = dH[i][0] * C[j][0];
          for (int k = 1; k < dim; ++k)
            sum += dH[i][k] * C[j][k];
          G[i][j] = sum * inverse;
        }
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        D[i][j] = V(0.5) * (G[i][j] + G[j][i]);
    logarithm_of(D);
    if constexpr (dim > 1)
      {
        V w[3] = {V(0.), V(0.), V(0.)}; // W x = w cross x
        w[2]   = V(0.5) * (G[1][0] - G[0][1]);
        if constexpr (dim == 3)
          {
            w[0] = V(0.5) * (G[2][1] - G[1][2]);
            w[1] = V(0.5) * (G[0][2] - G[2][0]);
          }
        if (polar)
          polar_spin(F, F_old, w);
        const V quarter = V(0.25) * (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
        cayley(w, quarter, Q);
        // the half of the rotation: tan(theta/4) from tan(theta/2) = |w|/2
        const V half = V(1.) / (V(1.) + square_root(V(V(1.) + quarter)));
        V       w_half[3], half_Q[dim][dim];
        for (int k = 0; k < 3; ++k)
          w_half[k] = half * w[k];
        cayley(w_half, V(half * half * quarter), half_Q);
        turn(half_Q, D);
      }
    else
      Q[0][0] = V(1.);
    set_strain(D);
    if constexpr (n_hoop > 0)
      {
        const V d = dh / (V(1.) + h - V(0.5) * dh), d2 = d * d;
        for (int i = dim; i < dim + n_hoop; ++i)
          strain[i] = d * (V(1.) + d2 * (V(1. / 12.) + d2 * V(1. / 80.)));
      }
    set_trace(log_volume_change());
  }

  /// The change of volume replaced, for a mean over a cell.
  ARENITE_INLINE void set_volume(const V &new_J_old, const V &new_J, const bool finite)
  {
    J_old          = new_J_old;
    J              = new_J;
    const V change = V(1. / 3.) * ((finite ? log_volume_change() : V(J - J_old)) - trace(strain)); // the deviator stays
    for (int i = 0; i < 3; ++i)
      strain[i] += change;
  }

  /// a <- Q a Q^T for a symmetric tensor in three dimensions at @p a, components [6][lane].
  ARENITE_INLINE void turn(double *a) const
  {
    if constexpr (dim > 1)
      {
        constexpr int n = n_lanes<V>();
        V             b[dim][dim];
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            b[i][j] = load<V>(a + index(i, j) * n);
        turn(Q, b);
        for (int i = 0; i < dim; ++i)
          for (int j = i; j < dim; ++j)
            store<V>(b[i][j], a + index(i, j) * n);
      }
    else
      (void)a;
  }

  /// a <- Q a for the vectors in the columns of @p a.
  template <int n>
  ARENITE_INLINE void turn_vectors(V (&a)[dim][n]) const
  {
    for (int k = 0; k < n; ++k)
      {
        V turned[dim];
        for (int i = 0; i < dim; ++i)
          {
            turned[i] = Q[i][0] * a[0][k];
            for (int j = 1; j < dim; ++j)
              turned[i] += Q[i][j] * a[j][k];
          }
        for (int i = 0; i < dim; ++i)
          a[i][k] = turned[i];
      }
  }

  /// Component of SymTensor.
  static constexpr int index(const int i, const int j) { return i == j ? i : 2 + i + j; }

private:
  ARENITE_INLINE V log_volume_change() const { return logarithm(V(J / J_old)); }

  ARENITE_INLINE void set_strain(const V (&D)[dim][dim])
  {
    for (int i = 0; i < dim; ++i)
      for (int j = i; j < dim; ++j)
        strain[index(i, j)] = V(0.5) * (D[i][j] + D[j][i]);
  }

  ARENITE_INLINE void set_trace(const V &wanted)
  {
    if constexpr (dim + n_hoop == 1) // nothing else can strain
      strain[0] = wanted;
    else
      {
        constexpr int n      = dim + n_hoop;
        V             change = wanted;
        for (int i = 0; i < n; ++i)
          change -= strain[i];
        change *= V(1. / n);
        for (int i = 0; i < n; ++i)
          strain[i] += change;
      }
  }

  /// D <- D + D^3/12 + D^5/80
  static ARENITE_INLINE void logarithm_of(V (&D)[dim][dim])
  {
    V D2[dim][dim], E[dim][dim]; // E = I + D^2/12 + D^4/80
    multiply(D, D, D2);
    multiply(D2, D2, E);
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        E[i][j] = V(i == j ? 1. : 0.) + V(1. / 12.) * D2[i][j] + V(1. / 80.) * E[i][j];
    multiply(D, E, D2);
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        D[i][j] = D2[i][j];
  }

  static ARENITE_INLINE void multiply(const V (&a)[dim][dim], const V (&b)[dim][dim], V (&c)[dim][dim])
  {
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        {
          V sum = a[i][0] * b[0][j];
          for (int k = 1; k < dim; ++k)
            sum += a[i][k] * b[k][j];
          c[i][j] = sum;
        }
  }

  /// a <- Q a Q^T
  static ARENITE_INLINE void turn(const V (&Q)[dim][dim], V (&a)[dim][dim])
  {
    V b[dim][dim];
    multiply(Q, a, b);
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        {
          V sum = b[i][0] * Q[j][0];
          for (int k = 1; k < dim; ++k)
            sum += b[i][k] * Q[j][k];
          a[i][j] = sum;
        }
  }

  /// Q = (I - W/2)^-1 (I + W/2) = I + (W + W^2/2)/(1 + |w|^2/4)
  static ARENITE_INLINE void cayley(const V (&w)[3], const V &quarter, V (&Q)[dim][dim])
  {
    const V s = V(1.) / (V(1.) + quarter), square = V(4.) * quarter;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        if (i == j)
          Q[i][i] = V(1.) + V(0.5) * s * (w[i] * w[i] - square);
        else
          {
            const int k = 3 - i - j; // W_ij = - epsilon_ijk w_k
            Q[i][j]     = s * (V(0.5) * w[i] * w[j] + ((j - i + 3) % 3 == 1 ? V(-w[k]) : w[k]));
          }
  }

  /// The vector whose Cayley rotation is R R_n^T.
  static ARENITE_INLINE void polar_spin(const V (&F)[dim][dim], const V (&F_old)[dim][dim], V (&w)[3])
  {
    V R[dim][dim], R_old[dim][dim], P[dim][dim];
    rotation_of(F, R);
    rotation_of(F_old, R_old);
    V trace = V(3. - dim); // of the rotation in three dimensions
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        {
          V sum = R[i][0] * R_old[j][0];
          for (int k = 1; k < dim; ++k)
            sum += R[i][k] * R_old[j][k];
          P[i][j] = sum;
          if (i == j)
            trace += sum;
        }
    const V scale = V(2.) / (V(1.) + trace);
    w[2]          = scale * (P[1][0] - P[0][1]);
    if constexpr (dim == 3)
      {
        w[0] = scale * (P[2][1] - P[1][2]);
        w[1] = scale * (P[0][2] - P[2][0]);
      }
  }

  /// Polar factor of F by R <- (R + R^-T)/2 from F/J^(1/3): quadratic, 9 steps are enough for stretches up to 1:1000 (Higham 1986).
  static ARENITE_INLINE void rotation_of(const V (&F)[dim][dim], V (&R)[dim][dim])
  {
    V C[dim][dim];
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        R[i][j] = F[i][j];
    for (int iteration = 0; iteration < 10; ++iteration)
      {
        const V inverse = V(1.) / cofactors(R, C);
        // the first step with F scaled to |R| = |R^-T|
        V a = V(1.), b = inverse;
        if (iteration == 0)
          {
            V norm = V(0.), norm_of_inverse = V(0.);
            for (int i = 0; i < dim; ++i)
              for (int j = 0; j < dim; ++j)
                {
                  norm += R[i][j] * R[i][j];
                  norm_of_inverse += C[i][j] * C[i][j];
                }
            a = square_root(V(square_root(V(norm_of_inverse * inverse * inverse / norm))));
            b = inverse / a;
          }
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            R[i][j] = V(0.5) * (a * R[i][j] + b * C[i][j]);
      }
  }
};
} // namespace Arenite
