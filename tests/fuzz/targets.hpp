/// Readers of files that a user hands in, each tried with any bytes. All that may come of them is what the file says,
/// or words about what is wrong with it; a target that sees anything else aborts.
///
/// A fuzzer calls one of them again and again (fuzz.cpp, cmake --preset fuzz); the test `fuzz_corpus` hands to each
/// what is in corpus/<name of the target> (test_corpus.cpp).
#pragma once

#include <string>

namespace titin {

void fuzz_scene(const std::string& bytes);       ///< TOML, units and values of keys
void fuzz_table(const std::string& bytes);       ///< tables of numbers: CSV, .sto, .mot
void fuzz_gmsh(const std::string& bytes);        ///< a mesh before MFEM sees it
void fuzz_mesh(const std::string& bytes);        ///< a mesh as a scene names it, through MFEM
void fuzz_checkpoint(const std::string& bytes);  ///< the head of a checkpoint
void fuzz_inspect(
    const std::string& bytes);  ///< run.json, history.csv and lists of saved times, as `titin inspect` reads them

}  // namespace titin
