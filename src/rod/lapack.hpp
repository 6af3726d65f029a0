/// The routines of LAPACK that rods call (Anderson et al. 1999, LAPACK Users' Guide): banded systems, eigenvalues.
#pragma once

extern "C" {
void dgbsv_(const int* n, const int* below, const int* above, const int* right_sides, double* ab, const int* rows,
            int* pivots, double* b, const int* b_rows, int* info);
void dsbgv_(const char* vectors, const char* triangle, const int* n, const int* a_half, const int* b_half, double* a,
            const int* a_rows, double* b, const int* b_rows, double* w, double* z, const int* z_rows, double* work,
            int* info);
void dggev_(const char* left, const char* right, const int* n, double* a, const int* a_rows, double* b,
            const int* b_rows, double* real, double* imaginary, double* beta, double* vl, const int* vl_rows,
            double* vr, const int* vr_rows, double* work, const int* work_size, int* info);
}
