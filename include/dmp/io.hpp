// include/dmp/io.hpp - what leaves a run, and what starts one again. POSIX systems; gnuplot and ParaView only look at the files.
#pragma once
#include <dmp/io/checkpoint.hpp>     // CheckpointWriter, CheckpointReader: named arrays, bit for bit, verified before use.
#include <dmp/io/csv.hpp>            // CsvTable: measurements against time, row by row, exact to the last bit.
#include <dmp/io/output_folder.hpp>  // OutputFolder: made and found writable before anything is computed.
#include <dmp/io/plot.hpp>           // plot: a gnuplot script in the folder, and its picture if gnuplot is there.
#include <dmp/io/vtk.hpp>            // write_vtp, TimeSeries: particles for ParaView.
