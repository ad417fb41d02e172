// include/dmp/geometry.hpp - where particles are: domains, shapes, lattices. Contracts: geometry/shape.hpp, geometry/lattice.hpp.
#pragma once
#include <dmp/geometry/box.hpp>              // Box: the domain of a scene, bounded or not, periodic or not.
#include <dmp/geometry/cylinder.hpp>         // Cylinder, a shape in 3D.
#include <dmp/geometry/fill.hpp>             // Points; fill a shape from a lattice, a line of points, merge.
#include <dmp/geometry/lattice.hpp>          // Cubic (square in 2D), Hexagonal (2D), FaceCentredCubic (3D).
#include <dmp/geometry/point_file.hpp>       // read_points: positions from a text file of your own.
#include <dmp/geometry/required_vector.hpp>  // RequiredVector: an Eigen vector that an aggregate cannot leave out.
#include <dmp/geometry/shape.hpp>            // Cuboid, Ball, HalfSpace, and a | b, a & b, a - b, !a of any shapes.
