#ifndef tests_scene_scene_text_h
#define tests_scene_scene_text_h

#include <kedge/base/exceptions.h>
#include <kedge/base/expression.h>
#include <kedge/scene/idle_settings.h>
#include <kedge/scene/read_scene.h>

#include <gtest/gtest.h>

#include <sstream>

using namespace kedge;

// Expected values are those written in the scenes. Numbers given as formulas
// differ from them by the rounding of a few operations.

// Scenes that the tests of the reader start from, and ways to change them.
namespace scene_tests
{
  constexpr double rounding = 1e-14;

  const std::string full_scene = R"(# a beam that says everything
set Dimension = 2
set Title = Cantilever

subsection Constants
  set force = load_per_length*h   # uses constants defined below it
  set h = 1
  set L = 10*h
  set load_per_length = 1e5
end

subsection Grid
  set Origin = 0, -5
  set Extent = L + 1, L
  set Cells  = (L + 1)/0.1, 20
end

subsection Materials
  subsection soft
    set Density = 1000
    set Young's modulus = 12e6
    set Poisson's ratio = 0.2
  end
  subsection stiff
    set Model = hencky
    set Density = 2000
    set Young's modulus = 12e7
    set Poisson's ratio = -0.1
    set Volume change = cell mean
  end
end

subsection Bodies
  subsection beam
    set Geometry = box(0, -h/2; L, h/2)
    set Material = stiff
    set Points per cell = 3
    set Basis = linear
    set Initial velocity = 0; max(x, y)*h
    set Body force = false
  end
  subsection ball
    set Geometry = ball(5, 3; h)
    set Material = soft
    set Points per cell = 2, 4
  end
end

subsection Node conditions
  subsection wall
    set Side = x-
    set Component x = fixed
  end
  subsection pin
    set Where = abs(x) < 1e-6 && abs(y) < 1e-6
    set Component x = velocity(sin(2*pi*t)*h)
    set Component y = displacement(t*L)
  end
end

subsection Body force
  set Acceleration = 0; -9.81
end

subsection Point loads
  subsection end load
    set Body = beam
    set Place = L, 0
    set Points = 2
    set Force = 0; -force*min(t, 1)
  end
end

subsection Tractions
  subsection top
    set Body = beam
    set Side = top
    set Where = x > L/2
    set Traction = 0; -1e3*t
  end
end

subsection Time
  set Scheme = generalised-alpha
  set Start = 1
  set End = 1 + 2*h
  set Step = 15 initial cfl
  set Smallest step factor = 1/64
  set Break times = 2.5, 2, 2.5
  set Newmark beta = 0.3
  set Newmark gamma = 0.6
  set Spectral radius = 0.9
  set Carry acceleration = false
end

subsection Newton
  set Tolerance = 1e-9
  set Iterations = 15
end

subsection Linear solver
  set Method = krylov-ilu
  set Tolerance = 1e-12
  set Iterations = 77
end

subsection Mapping
  set Velocity = pic
  set Lumping = 0.5
  set Audit = true
end

subsection Output
  set Points interval = 0.25
  set Points every steps = 4
  set Fields = displacement, det_F
  set Formats = hdf5
  set Grid = true
  set Checkpoint every steps = 10
  set Checkpoint interval = 5
  set Progress interval = 2
end

subsection Probes
  subsection tip
    set Body = beam
    set Place = L, 0
  end
  subsection end face
    set Face = right
  end
end

subsection Checks
  subsection deflection
    set Quantity = at(probe.tip.displacement_y)
    set Time = 2
    set Reference = -8.28
    set Tolerance = 0.5 %
    set Source = a table
  end
  subsection energy
    set Quantity = drift(history.total_energy)
    set Scale = 2*L
    set Tolerance = 1e-9
    set Source = conservation
  end
  subsection stress
    set Quantity = point_error(cauchy_stress_yy)
    set Exact = -80*(L - Y)
    set Tolerance = 1e-3
    set Source = closed form
  end
end
)";

  const std::string small_scene = R"(set Dimension = 3
subsection Grid
  set Extent = 1, 2, 3
  set Cells = 1, 2, 3
end
subsection Materials
  subsection steel
    set Density = 8000
    set Young's modulus = 2e11
    set Poisson's ratio = 0.3
  end
end
subsection Bodies
  subsection cube
    set Geometry = box(0, 0, 0; 1, 1, 1)
    set Material = steel
  end
end
subsection Time
  set End = 2
  set Step = 0.1
end
)";

  inline ParameterFile
  parse(const std::string &text)
  {
    std::istringstream input(text);
    return ParameterFile::read(input, "folder/beam.prm");
  }

  /** The error that a scene gives once some options are set. */
  template <int dim = 2>
  inline std::string
  message_of(const std::string &text, const std::vector<std::string> &settings = {})
  {
    try
      {
        ParameterFile file = parse(text);
        for (const std::string &setting : settings)
          file.set(setting);
        read_scene<dim>(file);
      }
    catch (const UserError &error)
      {
        return error.what();
      }
    return "no error";
  }

  /** The scene with a line added after the first one that holds @p after. */
  inline std::string
  with_line(const std::string &after, const std::string &line)
  {
    std::string       text = full_scene;
    const std::size_t end  = text.find('\n', text.find(after));
    return text.insert(end + 1, line + "\n");
  }

  /** The scene with the first @p from replaced. */
  inline std::string
  with(const std::string &from, const std::string &to)
  {
    std::string       text     = full_scene;
    const std::size_t position = text.find(from);
    EXPECT_NE(position, std::string::npos) << from;
    return text.replace(position, from.size(), to);
  }

  inline void
  expect_parts(const std::string &message, const std::vector<std::string> &parts)
  {
    for (const std::string &part : parts)
      EXPECT_NE(message.find(part), std::string::npos)
        << "missing: " << part << "\nin: " << message;
  }
} // namespace scene_tests

#endif
