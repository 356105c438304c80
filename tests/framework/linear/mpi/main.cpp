// Runs the tests on every process; one process's failure is everybody's.
#include <gtest/gtest.h>

#include "framework/parallel/parallel.hpp"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  sprekk::parallel::start_mpi();
  if (!sprekk::parallel::is_root())
    testing::UnitTest::GetInstance()->listeners().Release(
        testing::UnitTest::GetInstance()->listeners().default_xml_generator());
  const bool failed = RUN_ALL_TESTS() != 0;
  return sprekk::parallel::any(failed) ? 1 : 0;
}
