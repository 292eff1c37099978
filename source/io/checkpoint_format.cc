#include <kedge/io/checkpoint_format.h>

#include <cstring>
#include <sstream>
#include <stdexcept>
#include <type_traits>

namespace kedge
{
  namespace
  {
    const char *const magic = "kedge checkpoint 1";

    /** Appends plain data to a text. */
    class Packer
    {
    public:
      template <typename T>
      void
      put(const T *values, const std::size_t n)
      {
        static_assert(std::is_trivially_copyable_v<T>);
        content.append(reinterpret_cast<const char *>(values), n * sizeof(T));
      }

      void
      put(const std::uint64_t value)
      {
        put(&value, 1);
      }

      void
      put(const std::string &text)
      {
        put(text.size());
        content += text;
      }

      std::string content;
    };

    /** Takes it off again in the same order. */
    class Unpacker
    {
    public:
      explicit Unpacker(const std::string &content)
        : content(content)
      {}

      template <typename T>
      void
      get(T *values, const std::size_t n)
      {
        static_assert(std::is_trivially_copyable_v<T>);
        if (n > (content.size() - position) / sizeof(T))
          throw std::runtime_error("a file ends too early");
        if (n > 0)
          std::memcpy(static_cast<void *>(values), content.data() + position, n * sizeof(T));
        position += n * sizeof(T);
      }

      std::uint64_t
      number()
      {
        std::uint64_t value;
        get(&value, 1);
        return value;
      }

      /** A count of items of @p size bytes that are to follow. */
      std::size_t
      count(const std::size_t size)
      {
        const std::uint64_t n = number();
        if (n > (content.size() - position) / size)
          throw std::runtime_error("a file ends too early");
        return n;
      }

      std::string
      text()
      {
        std::string result(count(1), '\0');
        get(result.data(), result.size());
        return result;
      }

      void
      finish() const
      {
        if (position != content.size())
          throw std::runtime_error("a file is too long");
      }

    private:
      const std::string &content;
      std::size_t        position = 0;
    };
  } // namespace



  template <int dim>
  std::string
  pack_checkpoint(const CheckpointData<dim> &data)
  {
    Packer packer;
    packer.put(data.settings.size());
    for (const auto &[name, value] : data.settings)
      {
        packer.put(name);
        packer.put(value);
      }
    packer.put(data.scalars.size());
    for (const auto &[name, value] : data.scalars)
      {
        packer.put(name);
        packer.put(&value, 1);
      }
    packer.put(data.counters.size());
    for (const auto &[name, value] : data.counters)
      {
        packer.put(name);
        packer.put(value);
      }
    packer.put(data.arrays.size());
    for (const auto &[name, values] : data.arrays)
      {
        packer.put(name);
        packer.put(values.size());
        packer.put(values.data(), values.size());
      }
    packer.put(data.points.size());
    packer.put(data.points.data(), data.points.size());
    return std::move(packer.content);
  }



  template <int dim>
  CheckpointData<dim>
  unpack_checkpoint(const std::string &content)
  {
    CheckpointData<dim> data;
    Unpacker            unpacker(content);
    for (std::uint64_t n = unpacker.number(); n > 0; --n)
      {
        const std::string name = unpacker.text();
        data.settings[name]    = unpacker.text();
      }
    for (std::uint64_t n = unpacker.number(); n > 0; --n)
      {
        const std::string name = unpacker.text();
        unpacker.get(&data.scalars[name], 1);
      }
    for (std::uint64_t n = unpacker.number(); n > 0; --n)
      {
        const std::string name = unpacker.text();
        data.counters[name]    = unpacker.number();
      }
    for (std::uint64_t n = unpacker.number(); n > 0; --n)
      {
        const std::string    name   = unpacker.text();
        std::vector<double> &values = data.arrays[name];
        values.resize(unpacker.count(sizeof(double)));
        unpacker.get(values.data(), values.size());
      }
    data.points.resize(unpacker.count(sizeof(PointRecord<dim>)));
    unpacker.get(data.points.data(), data.points.size());
    unpacker.finish();
    return data;
  }



  std::string
  CheckpointManifest::text() const
  {
    std::ostringstream out;
    out << magic << '\n'
        << "dimension " << dim << '\n'
        << "state_values " << n_state_values << '\n'
        << "ranks " << files.size() << '\n';
    for (const File &file : files)
      out << "file " << file.n_bytes << ' ' << file.crc << '\n';
    const std::string body = out.str();
    return body + "crc " + std::to_string(crc32_of(body)) + '\n';
  }



  CheckpointManifest
  CheckpointManifest::parse(const std::string &text)
  {
    const std::size_t end = text.rfind("crc ");
    if (end == std::string::npos ||
        text.substr(end) != "crc " + std::to_string(crc32_of(text.substr(0, end))) + '\n')
      throw std::runtime_error("its manifest is not whole");

    CheckpointManifest manifest;
    std::istringstream in(text.substr(0, end));
    std::string        word;
    std::getline(in, word);
    if (word != magic)
      throw std::runtime_error("its manifest is of another format");
    std::size_t n_ranks = 0;
    in >> word >> manifest.dim >> word >> manifest.n_state_values >> word >> n_ranks;
    if (!in || n_ranks > end) // each rank has a line
      throw std::runtime_error("its manifest is not whole");
    manifest.files.resize(n_ranks);
    for (File &file : manifest.files)
      in >> word >> file.n_bytes >> file.crc;
    if (!in)
      throw std::runtime_error("its manifest is not whole");
    return manifest;
  }



  template std::string
  pack_checkpoint<2>(const CheckpointData<2> &);
  template std::string
  pack_checkpoint<3>(const CheckpointData<3> &);
  template CheckpointData<2>
  unpack_checkpoint<2>(const std::string &);
  template CheckpointData<3>
  unpack_checkpoint<3>(const std::string &);
} // namespace kedge
