#include "bundle/TarArchive.hpp"

#include <boost/beast/zlib/deflate_stream.hpp>
#include <boost/beast/zlib/zlib.hpp>
#include <boost/crc.hpp>
#include <boost/system/error_code.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

namespace ACS::Acsctl
{

namespace
{

constexpr std::size_t BLOCK = 512;
constexpr std::size_t LONGEST_NAME_IN_TAR = 100;

// Offsets and lengths of the fields of a header.
struct TarField
{
    std::size_t offset;
    std::size_t length;
};

constexpr TarField MODE{100, 8};
constexpr TarField OWNER{108, 8};
constexpr TarField GROUP{116, 8};
constexpr TarField SIZE{124, 12};
constexpr TarField TIME{136, 12};
constexpr TarField CHECKSUM{148, 8};
constexpr std::size_t TYPE_AT = 156;
constexpr std::size_t MAGIC_AT = 257;
constexpr std::uint64_t PRIVATE_MODE = 0600;

using Header = std::array<char, BLOCK>;

void Put(Header& header, std::size_t offset, std::string_view text)
{
    std::copy(text.begin(), text.end(), header.begin() + static_cast<std::ptrdiff_t>(offset));
}

/// Octal digits and a zero byte.
void PutNumber(Header& header, const TarField& field, std::uint64_t number)
{
    Put(header, field.offset, fmt::format("{:0{}o}", number, field.length - 1));
}

void AppendLittleEndian(std::string& out, std::uint32_t number)
{
    constexpr unsigned BYTE_BITS = 8;
    constexpr std::uint32_t BYTE_MASK = 0xFF;
    for (unsigned i = 0; i < sizeof(number); ++i)
    {
        out += static_cast<char>((number >> (i * BYTE_BITS)) & BYTE_MASK);
    }
}

} // namespace

void TarArchive::Add(std::string_view name, std::string_view content, std::int64_t modifiedAt)
{
    assert(name.size() <= LONGEST_NAME_IN_TAR);
    Header header{};
    Put(header, 0, name.substr(0, LONGEST_NAME_IN_TAR));
    PutNumber(header, MODE, PRIVATE_MODE);
    PutNumber(header, OWNER, 0);
    PutNumber(header, GROUP, 0);
    PutNumber(header, SIZE, content.size());
    PutNumber(header, TIME, static_cast<std::uint64_t>(std::max<std::int64_t>(modifiedAt, 0)));
    header[TYPE_AT] = '0';
    Put(header, MAGIC_AT, std::string_view("ustar\00000", 8));
    // The sum is computed with blanks in its own field.
    Put(header, CHECKSUM.offset, std::string(CHECKSUM.length, ' '));
    std::uint64_t sum = 0;
    for (const char byte : header)
    {
        sum += static_cast<unsigned char>(byte);
    }
    Put(header, CHECKSUM.offset, fmt::format("{:06o}", sum));
    header[CHECKSUM.offset + CHECKSUM.length - 2] = '\0';
    _bytes.append(header.data(), header.size());
    _bytes += content;
    _bytes.append((BLOCK - content.size() % BLOCK) % BLOCK, '\0');
}

std::string TarArchive::Finish() const
{
    return _bytes + std::string(2 * BLOCK, '\0');
}

std::string CompressGzip(std::string_view bytes)
{
    namespace Zlib = boost::beast::zlib;
    constexpr int WINDOW_BITS = 15;
    constexpr int MEMORY_LEVEL = 8;
    constexpr int LEVEL = 6;
    constexpr std::string_view GZIP_HEADER("\x1f\x8b\x08\0\0\0\0\0\0\xff", 10);
    Zlib::deflate_stream stream;
    stream.reset(LEVEL, WINDOW_BITS, MEMORY_LEVEL, Zlib::Strategy::normal);
    std::string packed(stream.upper_bound(bytes.size()) + BLOCK, '\0');
    Zlib::z_params parameters{};
    parameters.next_in = bytes.data();
    parameters.avail_in = bytes.size();
    parameters.next_out = packed.data();
    parameters.avail_out = packed.size();
    boost::system::error_code error;
    stream.write(parameters, Zlib::Flush::finish, error);
    assert(error == Zlib::error::end_of_stream); // there is room for all
    packed.resize(packed.size() - parameters.avail_out);
    boost::crc_32_type crc;
    crc.process_bytes(bytes.data(), bytes.size());
    std::string out = std::string(GZIP_HEADER) + packed;
    AppendLittleEndian(out, crc.checksum());
    AppendLittleEndian(out, static_cast<std::uint32_t>(bytes.size()));
    return out;
}

} // namespace ACS::Acsctl
