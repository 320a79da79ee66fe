// Files for many processes, and what happens when they cannot be written: the same OutputError on all processes, never a process
// that waits for the others.

#include <deal.II/base/hdf5.h>

#include <boost/test/unit_test.hpp>

#include <csignal>
#include <fstream>
#include <sys/mount.h>
#include <sys/resource.h>

#include "recorded_motion.h"

using namespace Arenite;
using namespace Arenite::Recorded;
using namespace dealii;

namespace
{
bool first_process() { return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0; }

/// A line of 1000 points, 101 rows of displacement: 2.4 MB.
struct Ray
{
  Ray()
    : mesh(Body::shell, 1, 1)
    , sets(R"(
set Receivers = ray
subsection Receivers
  subsection ray
    set Type       = line
    set Start      = 0.7, 0.6, 0.5
    set End        = 1.1, 1, 0.9
    set Number     = 1000
    set Interval   = 1e-2
    set Quantities = displacement
  end
end
)")
  {
    sets.receivers.reinit(*mesh.discretization, soil_everywhere);
  }

  void open(const std::string &folder) { sets.receivers.open(folder, 0., 1., nullptr); }

  void record()
  {
    State<dim> state;
    state.reinit(*mesh.discretization);
    for (; state.step <= 100; ++state.step, state.time += state.dt_last = 1e-2)
      {
        prescribe(state, *mesh.discretization, motion);
        sets.receivers.record(state);
      }
    sets.receivers.finish();
  }

  const Mesh         mesh;
  Sets               sets;
  const LinearMotion motion;
};

/// Largest size of a file of this process.
class FileSizeLimit
{
public:
  explicit FileSizeLimit(const rlim_t bytes)
  {
    getrlimit(RLIMIT_FSIZE, &old_limit);
    old_handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, old_limit.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit()
  {
    setrlimit(RLIMIT_FSIZE, &old_limit);
    std::signal(SIGXFSZ, old_handler);
  }
  FileSizeLimit(const FileSizeLimit &) = delete;

private:
  rlimit old_limit;
  void (*old_handler)(int);
};

/// A disk of its own in a folder, for as long as the object lives.
class SmallDisk
{
public:
  SmallDisk(const std::string &path, const unsigned int kilobytes)
    : path(path)
  {
    bool mounted = false;
    if (first_process())
      {
        std::filesystem::create_directory(path);
        const std::string size = "size=" + std::to_string(kilobytes) + "k";
        mounted                = mount("tmpfs", path.c_str(), "tmpfs", 0, size.c_str()) == 0;
      }
    exists = Utilities::MPI::broadcast(MPI_COMM_WORLD, mounted);
    BOOST_TEST_MESSAGE((exists ? "small disk: " : "not allowed to mount a small disk: ") + path);
  }
  ~SmallDisk()
  {
    MPI_Barrier(MPI_COMM_WORLD);
    if (first_process() && exists)
      umount2(path.c_str(), MNT_DETACH);
    MPI_Barrier(MPI_COMM_WORLD);
  }
  SmallDisk(const SmallDisk &) = delete;

  void fill_to_the_brim() const
  {
    if (first_process())
      {
        std::ofstream           filler(path + "/filler", std::ios::binary);
        const std::vector<char> page(4096, 'x');
        while (filler.write(page.data(), page.size()).flush())
          ;
      }
    MPI_Barrier(MPI_COMM_WORLD);
  }

  bool exists = false;

private:
  const std::string path;
};

bool no_space(const OutputError &error) { return mentions(error, {"receivers.h5", "No space left"}); }
} // namespace

BOOST_AUTO_TEST_SUITE(receivers)

// Planes and lines: one file that all processes write, also those without a point of the set; rows at multiples of the interval, velocities exact there too; the last row is the end time.
BOOST_AUTO_TEST_CASE(hdf5_sets, *boost::unit_test::label("parallel"))
{
  const Folder       folder;
  const LinearMotion motion;
  const Mesh         mesh(Body::shell, 2, 1);
  Sets               sets(R"(
set Receivers = cut, ray
subsection Receivers
  subsection cut
    set Type          = plane
    set Corner        = 1, 0.3, 0.3
    set First edge    = 0.5, 0, 0
    set Second edge   = 0, 0.5, 0.5
    set First number  = 11
    set Second number = 7
    set Interval      = 2.5e-3
  end
  subsection ray
    set Type       = line
    set Start      = 0.7, 0.6, 0.5
    set End        = 1.1, 1, 0.9
    set Number     = 2
    set Quantities = stress
    set Interval   = 1e-2
  end
end
)");
  State<dim>         state;
  state.reinit(*mesh.discretization);
  sets.receivers.reinit(*mesh.discretization, soil_everywhere);
  sets.receivers.open(folder.path, 0., 0.02, nullptr);
  state.dt_last = 0.;
  for (; state.step <= 50; ++state.step, state.time += state.dt_last = 4e-4)
    {
      prescribe(state, *mesh.discretization, motion);
      sets.receivers.record(state);
    }
  sets.receivers.finish();
  HDF5::File  file(folder.path + "/receivers.h5", HDF5::File::FileAccessMode::open, MPI_COMM_WORLD);
  HDF5::Group cut      = file.open_group("cut");
  const auto  time     = cut.open_dataset("time").read<std::vector<double>>();
  const auto  position = cut.open_dataset("position").read<FullMatrix<double>>();
  BOOST_TEST(cut.open_dataset("velocity").get_attribute<std::string>("unit") == "m/s");
  BOOST_TEST(time.size() == 9u);
  BOOST_TEST(position.m() == 77u);
  BOOST_TEST(time[1] == 2.8e-3, boost::test_tools::tolerance(1e-12)); // first step at or after 2.5 ms
  BOOST_TEST(time[8] == 2e-2, boost::test_tools::tolerance(1e-12));
  const auto u      = cut.open_dataset("displacement").read_hyperslab<std::vector<double>>({0, 0, 0}, {9, 77, 3});
  const auto v      = cut.open_dataset("velocity").read_hyperslab<std::vector<double>>({0, 0, 0}, {9, 77, 3});
  const auto stress = cut.open_dataset("stress").read_hyperslab<std::vector<double>>({0, 0, 0}, {9, 77, 6});
  double     error  = 0.;
  for (unsigned int row = 0; row < 9; ++row)
    for (unsigned int point = 0; point < 77; ++point)
      {
        const Point<dim> x(position(point, 0), position(point, 1), position(point, 2));
        for (unsigned int c = 0; c < dim; ++c)
          {
            const unsigned int i       = (row * 77 + point) * dim + c;
            const auto         exact_u = motion.displacement(x, time[row]), exact_v = motion.velocity(x, time[row]);
            const auto         exact_stress = motion.stress(x, time[row]);
            error                           = std::max({error, std::abs(u[i] - exact_u[c]) / exact_u.norm(),
                                                        std::abs(v[i] - exact_v[c]) / exact_v.norm(),
                                                        std::abs(stress[2 * (i - c) + c] - exact_stress[c][c]) / exact_stress.norm()});
          }
      }
  BOOST_TEST(error < 1e-9);
  const auto ray_time = file.open_group("ray").open_dataset("time").read<std::vector<double>>();
  BOOST_TEST(ray_time.size() == 3u);
  BOOST_TEST(ray_time[2] == 2e-2, boost::test_tools::tolerance(1e-12));
  const auto ray_stress =
    file.open_group("ray").open_dataset("stress").read_hyperslab<std::vector<double>>({2, 1, 0}, {1, 1, 6});
  const auto exact_stress = motion.stress(Point<dim>(1.1, 1, 0.9), 2e-2);
  for (unsigned int k = 0; k < 6; ++k)
    BOOST_TEST(std::abs(ray_stress[k] - exact_stress.access_raw_entry(k)) < 1e-9 * exact_stress.norm());
}

// A device that is always full: all processes get the same error with the name of the file.
BOOST_AUTO_TEST_CASE(full_disk, *boost::unit_test::label("parallel"))
{
  if (!std::filesystem::exists("/dev/full"))
    return;
  const Folder folder;
  const Mesh   mesh(Body::shell, 1, 1);
  Sets         sets(array_scene);
  sets.receivers.reinit(*mesh.discretization, soil_everywhere);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::filesystem::create_symlink("/dev/full", folder.path + "/receivers-array.csv");
  MPI_Barrier(MPI_COMM_WORLD);
  BOOST_CHECK_EXCEPTION(sets.receivers.open(folder.path, 0., 1., nullptr), OutputError, [](const OutputError &error) {
    return mentions(error, {"receivers-array.csv", "No space left"});
  });
}

// A disk, or a limit of the user, that is too small for receivers.h5 shows before the first row, and no file is left.
BOOST_AUTO_TEST_CASE(space_for_hdf5, *boost::unit_test::label("parallel"))
{
  const Folder folder;
  for (const rlim_t limit : {0, 1000, 20000, 2000000})
    {
      Ray                 ray;
      const FileSizeLimit small(limit);
      BOOST_CHECK_EXCEPTION(ray.open(folder.path), OutputError, [](const OutputError &error) {
        return mentions(error, {"receivers.h5", "File too large"});
      });
      BOOST_TEST(!std::filesystem::exists(folder.path + "/receivers.h5"));
    }
  for (const unsigned int kilobytes : {4, 40, 200, 2000})
    {
      const SmallDisk disk(folder.path + "/disk", kilobytes);
      if (!disk.exists)
        return;
      Ray ray;
      BOOST_CHECK_EXCEPTION(ray.open(folder.path + "/disk"), OutputError, no_space);
      BOOST_TEST(!std::filesystem::exists(folder.path + "/disk/receivers.h5"));
    }
}

// Rows have their place on the disk from the beginning: a disk that others fill during the run does not matter.
BOOST_AUTO_TEST_CASE(disk_fills_during_the_run, *boost::unit_test::label("parallel"))
{
  const Folder    folder;
  const SmallDisk disk(folder.path + "/disk", 4000);
  if (!disk.exists)
    return;
  Ray ray;
  ray.open(folder.path + "/disk");
  disk.fill_to_the_brim();
  ray.record();
  HDF5::File file(folder.path + "/disk/receivers.h5", HDF5::File::FileAccessMode::open, MPI_COMM_WORLD);
  const auto u =
    file.open_group("ray").open_dataset("displacement").read_hyperslab<std::vector<double>>({0, 0, 0}, {101, 1000, 3});
  double error = 0.;
  for (unsigned int row = 0; row < 101; ++row)
    for (unsigned int point = 0; point < 1000; ++point)
      {
        const double     s     = point / 999.;
        const Point<dim> x     = Point<dim>(0.7, 0.6, 0.5) + 0.4 * s * Point<dim>(1, 1, 1);
        const auto       exact = ray.motion.displacement(x, row * 1e-2);
        for (unsigned int c = 0; c < dim; ++c)
          error = std::max(error, std::abs(u[(row * 1000 + point) * dim + c] - exact[c]) / exact.norm());
      }
  BOOST_TEST(error < 1e-9);
}

// What cannot be foreseen: the last process alone is not allowed to write. All hear of it, while the file is open.
BOOST_AUTO_TEST_CASE(one_process_fails, *boost::unit_test::label("parallel"))
{
  const Folder       folder;
  const unsigned int rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  Ray                ray;
  ray.open(folder.path);
  std::unique_ptr<FileSizeLimit> limit;
  if (rank + 1 == Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD))
    limit = std::make_unique<FileSizeLimit>(1000);
  BOOST_CHECK_EXCEPTION(ray.record(), OutputError,
                        [](const OutputError &error) { return mentions(error, {"receivers.h5"}); });
}

BOOST_AUTO_TEST_CASE(missing_folder, *boost::unit_test::label("parallel"))
{
  const Folder folder;
  Ray          ray;
  BOOST_CHECK_EXCEPTION(ray.open(folder.path + "/missing"), OutputError, [](const OutputError &error) {
    return mentions(error, {"missing/receivers.h5", "No such file"});
  });
}

BOOST_AUTO_TEST_SUITE_END()
