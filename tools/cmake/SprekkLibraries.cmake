# The outside libraries, each as one target whose headers are system includes (no warnings from them).
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(yaml-cpp REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(GTest REQUIRED)
find_package(MPI REQUIRED COMPONENTS C)
link_libraries(Eigen3::Eigen)

find_library(GMSH_LIBRARY gmsh REQUIRED)
find_path(GMSH_INCLUDE gmsh.h REQUIRED)
add_library(gmsh_library INTERFACE)
target_include_directories(gmsh_library SYSTEM INTERFACE ${GMSH_INCLUDE})
target_link_libraries(gmsh_library INTERFACE ${GMSH_LIBRARY})

add_library(mpi_library INTERFACE)
target_compile_definitions(mpi_library INTERFACE OMPI_SKIP_MPICXX)
target_link_libraries(mpi_library INTERFACE MPI::MPI_C)

find_library(UMFPACK_LIBRARY umfpack REQUIRED)
find_path(UMFPACK_INCLUDE umfpack.h PATH_SUFFIXES suitesparse REQUIRED)
add_library(umfpack_library INTERFACE)
target_include_directories(umfpack_library SYSTEM INTERFACE ${UMFPACK_INCLUDE})
target_link_libraries(umfpack_library INTERFACE ${UMFPACK_LIBRARY})

find_library(DMUMPS_LIBRARY dmumps REQUIRED)
add_library(mumps_library INTERFACE)
target_link_libraries(mumps_library INTERFACE ${DMUMPS_LIBRARY} mpi_library)

find_package(BLAS REQUIRED)
add_library(blas_library INTERFACE)
target_link_libraries(blas_library INTERFACE BLAS::BLAS ${CMAKE_DL_LIBS})

find_package(Trilinos REQUIRED COMPONENTS Tpetra Belos Ifpack2 MueLu Zoltan2)
add_library(trilinos_library INTERFACE)
target_include_directories(trilinos_library SYSTEM INTERFACE ${Trilinos_INCLUDE_DIRS})
target_link_libraries(trilinos_library INTERFACE ${Trilinos_LIBRARIES} mpi_library)

find_package(VTK REQUIRED COMPONENTS CommonCore CommonDataModel CommonExecutionModel CommonMisc IOXML IOXMLParser)
add_library(vtk_library INTERFACE)
target_link_libraries(vtk_library INTERFACE ${VTK_LIBRARIES})

find_package(HDF5 REQUIRED COMPONENTS C)
add_library(hdf5_headers INTERFACE)
target_include_directories(hdf5_headers SYSTEM INTERFACE ${HDF5_C_INCLUDE_DIRS})
add_library(hdf5_library INTERFACE)
target_link_libraries(hdf5_library INTERFACE hdf5_headers ${HDF5_C_LIBRARIES})
