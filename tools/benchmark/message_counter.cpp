// Counts what a process sends to others by MPI, and its processor time outside of MPI; to be loaded before the program
// by LD_PRELOAD (tools/benchmark/scaling.py). Where processes share cores, wall time says nothing; and processor time
// includes the time in which a process waits for messages, since it polls for them.
//
// At the end each process writes MESSAGE_COUNTER.RANK: its processor seconds outside of MPI, its largest memory, and a
// table of calls, messages, bytes given to others and seconds inside of MPI by the library that called. steady_clock is
// replaced by the processor time outside of MPI, so that the seconds of run.json are those, too.
#define OMPI_SKIP_MPICXX 1  // the bindings of C alone
#include <dlfcn.h>
#include <mpi.h>
#include <sys/resource.h>
#include <time.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

namespace {

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Count {
  long calls = 0, messages = 0;
  double bytes = 0, seconds = 0;
};

int depth = 0, my_rank = 0;
double inside = 0;  // processor seconds inside of MPI

std::map<std::string, Count>& counts() {
  static auto* const all = new std::map<std::string, Count>;
  return *all;
}

/// The file name of the library that has this address.
const std::string& library_of(void* address) {
  static auto* const known = new std::map<void*, std::string>;
  std::string& name = (*known)[address];
  if (name.empty()) {
    Dl_info info{};
    name = dladdr(address, &info) != 0 && info.dli_fname != nullptr ? info.dli_fname : "unknown";
    name = name.substr(name.find_last_of('/') + 1);
  }
  return name;
}

template <class Function>
Function* real(Function*, const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

double size_of(double count, MPI_Datatype type) {
  static auto* const size = real(&PMPI_Type_size, "PMPI_Type_size");
  int bytes = 0;
  if (type != MPI_DATATYPE_NULL) size(type, &bytes);
  return count * bytes;
}

int processes(MPI_Comm comm) {
  static auto* const size = real(&PMPI_Comm_size, "PMPI_Comm_size");
  int several = 1;
  size(comm, &several);
  return several;
}

double sum(const int* counts, MPI_Comm comm) {
  double all = 0;
  for (int p = 0; p < processes(comm); ++p) all += counts[p];
  return all;
}

/// Counts one call, from its construction to its destruction. Calls of MPI inside of MPI are not counted.
class Call {
 public:
  Call(void* from, const char* function, long messages, double bytes) : start_(processor_seconds()) {
    if (depth++ > 0) return;
    count_ = &counts()[library_of(from) + " " + (function + 1)];
    ++count_->calls;
    count_->messages += messages;
    count_->bytes += bytes;
  }
  ~Call() {
    if (--depth > 0) return;
    const double seconds = processor_seconds() - start_;
    count_->seconds += seconds;
    inside += seconds;
  }
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

 private:
  double start_;
  Count* count_ = nullptr;
};

void write_table() {
  const char* const name = std::getenv("MESSAGE_COUNTER");
  std::FILE* const file = name == nullptr ? nullptr : std::fopen((name + ("." + std::to_string(my_rank))).c_str(), "w");
  if (file == nullptr) return;
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  std::fprintf(file, "seconds,%.3f\nmemory,%ld\n", processor_seconds() - inside, used.ru_maxrss * 1024);
  for (const auto& [of, count] : counts())
    std::fprintf(file, "%s,%ld,%ld,%.0f,%.3f\n", of.c_str(), count.calls, count.messages, count.bytes, count.seconds);
  std::fclose(file);
}

}  // namespace

// An allreduce, a broadcast and their like are counted with the bytes that a process gives to them, as one message.
#define COUNTED(function, parameters, arguments, messages, bytes)                 \
  extern "C" int P##function parameters {                                         \
    static auto* const next = real(&P##function, "P" #function);                  \
    const Call call(__builtin_return_address(0), "P" #function, messages, bytes); \
    return next arguments;                                                        \
  }                                                                               \
  extern "C" int function parameters {                                            \
    static auto* const next = real(&P##function, "P" #function);                  \
    const Call call(__builtin_return_address(0), "P" #function, messages, bytes); \
    return next arguments;                                                        \
  }

#define SEND(function)                                                                                \
  COUNTED(function, (const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm), \
          (data, count, type, to, tag, comm), 1, size_of(count, type))
#define SEND_LATER(function)                                                                                      \
  COUNTED(function,                                                                                               \
          (const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* request), \
          (data, count, type, to, tag, comm, request), 1, size_of(count, type))
SEND(MPI_Send)
SEND(MPI_Ssend)
SEND(MPI_Bsend)
SEND(MPI_Rsend)
SEND_LATER(MPI_Isend)
SEND_LATER(MPI_Issend)
SEND_LATER(MPI_Ibsend)
SEND_LATER(MPI_Irsend)

COUNTED(MPI_Recv, (void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Status* status),
        (data, count, type, from, tag, comm, status), 0, 0)
COUNTED(MPI_Irecv, (void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Request* request),
        (data, count, type, from, tag, comm, request), 0, 0)
COUNTED(MPI_Probe, (int from, int tag, MPI_Comm comm, MPI_Status* status), (from, tag, comm, status), 0, 0)
COUNTED(MPI_Iprobe, (int from, int tag, MPI_Comm comm, int* is_there, MPI_Status* status),
        (from, tag, comm, is_there, status), 0, 0)
COUNTED(MPI_Wait, (MPI_Request * request, MPI_Status* status), (request, status), 0, 0)
COUNTED(MPI_Waitall, (int count, MPI_Request* requests, MPI_Status* status), (count, requests, status), 0, 0)
COUNTED(MPI_Waitany, (int count, MPI_Request* requests, int* which, MPI_Status* status),
        (count, requests, which, status), 0, 0)
COUNTED(MPI_Test, (MPI_Request * request, int* is_done, MPI_Status* status), (request, is_done, status), 0, 0)
COUNTED(MPI_Testall, (int count, MPI_Request* requests, int* is_done, MPI_Status* status),
        (count, requests, is_done, status), 0, 0)
COUNTED(MPI_Sendrecv,
        (const void* data, int count, MPI_Datatype type, int to, int tag, void* got, int got_count, MPI_Datatype of,
         int from, int got_tag, MPI_Comm comm, MPI_Status* status),
        (data, count, type, to, tag, got, got_count, of, from, got_tag, comm, status), 1, size_of(count, type))
COUNTED(MPI_Barrier, (MPI_Comm comm), (comm), 1, 0)
COUNTED(MPI_Bcast, (void* data, int count, MPI_Datatype type, int root, MPI_Comm comm), (data, count, type, root, comm),
        1, size_of(count, type))
COUNTED(MPI_Allreduce, (const void* data, void* got, int count, MPI_Datatype type, MPI_Op operation, MPI_Comm comm),
        (data, got, count, type, operation, comm), 1, size_of(count, type))
COUNTED(MPI_Reduce,
        (const void* data, void* got, int count, MPI_Datatype type, MPI_Op operation, int root, MPI_Comm comm),
        (data, got, count, type, operation, root, comm), 1, size_of(count, type))
COUNTED(MPI_Scan, (const void* data, void* got, int count, MPI_Datatype type, MPI_Op operation, MPI_Comm comm),
        (data, got, count, type, operation, comm), 1, size_of(count, type))
COUNTED(MPI_Reduce_scatter,
        (const void* data, void* got, const int* each, MPI_Datatype type, MPI_Op operation, MPI_Comm comm),
        (data, got, each, type, operation, comm), 1, size_of(sum(each, comm), type))
COUNTED(MPI_Gather,
        (const void* data, int count, MPI_Datatype type, void* got, int got_count, MPI_Datatype of, int root,
         MPI_Comm comm),
        (data, count, type, got, got_count, of, root, comm), 1, size_of(count, type))
COUNTED(MPI_Gatherv,
        (const void* data, int count, MPI_Datatype type, void* got, const int* each, const int* starts, MPI_Datatype of,
         int root, MPI_Comm comm),
        (data, count, type, got, each, starts, of, root, comm), 1, size_of(count, type))
COUNTED(MPI_Allgather,
        (const void* data, int count, MPI_Datatype type, void* got, int got_count, MPI_Datatype of, MPI_Comm comm),
        (data, count, type, got, got_count, of, comm), 1, size_of(count, type))
COUNTED(MPI_Allgatherv,
        (const void* data, int count, MPI_Datatype type, void* got, const int* each, const int* starts, MPI_Datatype of,
         MPI_Comm comm),
        (data, count, type, got, each, starts, of, comm), 1, size_of(count, type))
COUNTED(MPI_Alltoall,
        (const void* data, int count, MPI_Datatype type, void* got, int got_count, MPI_Datatype of, MPI_Comm comm),
        (data, count, type, got, got_count, of, comm), processes(comm) - 1,
        size_of(1.0 * count * processes(comm), type))
COUNTED(MPI_Alltoallv,
        (const void* data, const int* each, const int* starts, MPI_Datatype type, void* got, const int* got_each,
         const int* got_starts, MPI_Datatype of, MPI_Comm comm),
        (data, each, starts, type, got, got_each, got_starts, of, comm), processes(comm) - 1,
        size_of(sum(each, comm), type))
COUNTED(MPI_Comm_dup, (MPI_Comm comm, MPI_Comm* made), (comm, made), 1, 0)
COUNTED(MPI_Comm_split, (MPI_Comm comm, int color, int key, MPI_Comm* made), (comm, color, key, made), 1, 0)
COUNTED(MPI_Comm_create, (MPI_Comm comm, MPI_Group group, MPI_Comm* made), (comm, group, made), 1, 0)
COUNTED(MPI_Comm_free, (MPI_Comm * comm), (comm), 1, 0)
COUNTED(MPI_Init, (int* count, char*** arguments), (count, arguments), 0, 0)

extern "C" int MPI_Finalize() {
  static auto* const rank = real(&PMPI_Comm_rank, "PMPI_Comm_rank");
  rank(MPI_COMM_WORLD, &my_rank);
  write_table();
  static auto* const next = real(&PMPI_Finalize, "PMPI_Finalize");
  return next();
}

/// A process that waits for a message sleeps, and leaves the core to the one for which it waits.
extern "C" int sched_yield() noexcept {
  constexpr timespec a_little{0, 20'000};  // 20 us, about what a message takes
  return nanosleep(&a_little, nullptr);
}

/// The clock of the program: its processor time outside of MPI.
std::chrono::steady_clock::time_point std::chrono::steady_clock::now() noexcept {
  return time_point(duration_cast<duration>(std::chrono::duration<double>(processor_seconds() - inside)));
}
