#include "verdict.h"

int main(int argc, char** argv) { return tera::bench::RunAndJudge(argc, argv); }
