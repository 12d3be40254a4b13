#include "bundle/TarArchive.hpp"

#include "Catch.hpp"

#include <boost/crc.hpp>

#include <string>

namespace Acsctl = ACS::Acsctl;

TEST_CASE("A file of an archive has a header and whole blocks")
{
    Acsctl::TarArchive archive;
    archive.Add("a/b.json", "{}", 1'700'000'000);
    archive.Add("a/empty", "", -1);
    const std::string bytes = archive.Finish();
    REQUIRE(bytes.size() == 512 * (2 + 1 + 2));
    CHECK(bytes.substr(0, 10) == std::string("a/b.json\0\0", 10));
    CHECK(bytes.substr(100, 8) == std::string("0000600\0", 8));
    CHECK(bytes.substr(124, 12) == std::string("00000000002\0", 12));
    CHECK(bytes.substr(136, 12) == std::string("14524770400\0", 12));
    CHECK(bytes.substr(257, 8) == std::string("ustar\00000", 8));
    CHECK(bytes.substr(512, 3) == std::string("{}\0", 3));
    CHECK(bytes.substr(1'024 + 136, 12) == std::string("00000000000\0", 12));
    unsigned sum = 0;
    for (std::size_t i = 0; i < 512; ++i)
    {
        sum += static_cast<unsigned char>(i >= 148 && i < 156 ? ' ' : bytes[i]);
    }
    CHECK(std::stoul(bytes.substr(148, 6), nullptr, 8) == sum);
}

TEST_CASE("A compressed text ends with its sum and its length")
{
    const std::string text = std::string(100'000, 'x') + "end";
    const std::string packed = Acsctl::CompressGzip(text);
    CHECK(packed.size() < 1'000);
    CHECK(packed.substr(0, 3) == "\x1f\x8b\x08");
    boost::crc_32_type crc;
    crc.process_bytes(text.data(), text.size());
    const auto readNumber = [&packed](std::size_t fromEnd) {
        unsigned long number = 0;
        for (std::size_t i = 0; i < 4; ++i)
        {
            number |= static_cast<unsigned long>(static_cast<unsigned char>(packed[packed.size() - fromEnd + i]))
                << (8 * i);
        }
        return number;
    };
    CHECK(readNumber(8) == crc.checksum());
    CHECK(readNumber(4) == text.size());
    CHECK_FALSE(Acsctl::CompressGzip("").empty());
}
