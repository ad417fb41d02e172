#pragma once
// Solids of beads and bonds: what one needs before a run to make them, and after it to read them.
#include <dmp/lattice_spring/bar_test.hpp>            // Young's modulus and Poisson ratio of a bar drawn at its ends.
#include <dmp/lattice_spring/body.hpp>                // Body: points and bonds, ready for a scene.
#include <dmp/lattice_spring/connectivity.hpp>        // Bonds per bead, mean coordination.
#include <dmp/lattice_spring/elastic_constants.hpp>   // E, nu, Lame's, K, and the springs' Q, C, D: all from any two.
#include <dmp/lattice_spring/equilibrium.hpp>         // Displacements under supports and loads at small strain: conjugate gradients.
#include <dmp/lattice_spring/folds.hpp>               // Beads around which a body has turned inside out.
#include <dmp/lattice_spring/hardy_stress.hpp>        // Stress averaged over a ball anywhere in a body.
#include <dmp/lattice_spring/hertz.hpp>               // Sphere between plates: force, contact, stress on the axis, relaxation.
#include <dmp/lattice_spring/hertz_fit.hpp>           // Young's modulus of a sphere from its force curve, with a free zero.
#include <dmp/lattice_spring/inertia_free.hpp>        // Steps of slow viscoelastic loading as states of rest of other springs.
#include <dmp/lattice_spring/interior.hpp>            // What of a cuboid or ball lies so deep that no bond is missing.
#include <dmp/lattice_spring/lattice.hpp>             // CubicLattice, TriangularLattice, SquareLattice, turned at will.
#include <dmp/lattice_spring/lattice_body.hpp>        // Shapes and blocks of lattice, with full or shared bonds in the surface.
#include <dmp/lattice_spring/lattice_elasticity.hpp>  // Bond stiffness of a lattice from Young's modulus, and back.
#include <dmp/lattice_spring/local_stiffness.hpp>     // What holds a bead: mechanisms, highest frequency, stable time step.
#include <dmp/lattice_spring/local_strain.hpp>        // Strain of the beads in a ball by least squares.
#include <dmp/lattice_spring/network.hpp>             // Bonds between all points within reach; k or k L uniform.
#include <dmp/lattice_spring/network_elasticity.hpp>  // Bond stiffness of a network from its bulk modulus; imbalance S_kL.
#include <dmp/lattice_spring/principal_stress.hpp>    // Principal stresses, largest shear stress.
#include <dmp/lattice_spring/random_points.hpp>       // Random sequential addition with a least distance.
#include <dmp/lattice_spring/scatter.hpp>             // Scatter of values along a line: Delta, Delta_t, Delta_r.
#include <dmp/lattice_spring/section_force.hpp>       // Force across a plane, mean stress of a region.
#include <dmp/lattice_spring/small_strain.hpp>        // Tensions and forces of small displacements, with dispersion.
#include <dmp/lattice_spring/split.hpp>               // Core and shell, or any division of the bonds among laws.
#include <dmp/lattice_spring/springs.hpp>             // Stiffness and dispersion of the springs of a body, from its elastic constants.
#include <dmp/lattice_spring/stress_tuning.hpp>       // ikL-tune: weights that make forces vanish and stress even under uniform strain.
#include <dmp/lattice_spring/tension.hpp>             // Tensions of bonds from positions and velocities.
#include <dmp/lattice_spring/tensor.hpp>              // Tensor: second rank.
#include <dmp/lattice_spring/tuning.hpp>              // kL-tune: weights that make forces vanish under uniform strain.
#include <dmp/lattice_spring/virial_stress.hpp>       // Stress of each bead.
