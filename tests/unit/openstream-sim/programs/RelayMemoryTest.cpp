#include "programs/RelayMemory.hpp"

#include "Catch.hpp"

using namespace ACS::OpenStreamSim; // NOLINT(google-build-using-namespace)

namespace
{

RelayName Name(std::string_view text)
{
    const std::optional<RelayName> name = ParseRelayNameOrNull(text);
    INFO(text);
    REQUIRE(name.has_value());
    return *name;
}

} // namespace

TEST_CASE("m100 counts bits, mb400, mw200, ml100 and mf100 all begin at byte 400")
{
    REQUIRE(GetFirstByte(Name("m100")) == 12);
    for (const char* text : {"mb400", "mw200", "ml100", "mf100"})
    {
        REQUIRE(GetFirstByte(Name(text)) == 400);
    }
}

TEST_CASE("A name has a known area, a known width and a place inside its block")
{
    REQUIRE(Name("fb0.di23") == RelayName{{ERelayBus::Fb, 0, ERelayArea::Di}, ERelayWidth::Bit, 23});
    REQUIRE(Name("fn63.dow7") == RelayName{{ERelayBus::Fn, 63, ERelayArea::Do}, ERelayWidth::Word, 7});
    REQUIRE(Name("s3").block.area == ERelayArea::S);
    REQUIRE(Name("si3").block.area == ERelayArea::Si);
    REQUIRE(Name("mb4095").number == 4095);
    REQUIRE(Name("m32767").number == 32767);
    for (const char* text :
         {"",
          "m",
          "100",
          "q1",
          "mz1",
          "mbb1",
          "m-1",
          "m1x",
          "mb4096",
          "mw2048",
          "ml1024",
          "m32768",
          "fb10.di1",
          "fb0.si1",
          "fn0.sob1",
          "fn64.di1",
          "fb.di1",
          "fb0di1",
          "fb0_di1",
          "m99999999999999999999999",
          "m4611686018427387904",
          "ml4611686018427387904"})
    {
        INFO(text);
        REQUIRE_FALSE(ParseRelayNameOrNull(text).has_value());
    }
}

TEST_CASE("A block of val_s32 is one of the documented areas, with or without a fieldbus")
{
    for (const char* text : {"di", "do", "x", "y", "m", "s", "r", "k", "fb0_di", "fn12_do"})
    {
        INFO(text);
        REQUIRE(ParseRelayBlockOrNull(text).has_value());
    }
    for (const char* text : {"", "si", "so", "mb", "fb0", "fb0.di", "fbx_di", "fb_di", "z"})
    {
        INFO(text);
        REQUIRE_FALSE(ParseRelayBlockOrNull(text).has_value());
    }
}

TEST_CASE("Values are little-endian, signed, and leave their neighbours alone")
{
    RelayMemory memory;
    REQUIRE(memory.Read(Name("ml100")) == 0.0);
    REQUIRE(memory.Write(Name("ml100"), -1.0).has_value());
    REQUIRE(memory.Read(Name("mb401")) == -1.0);
    REQUIRE(memory.Write(Name("mb401"), 0x12).has_value());
    REQUIRE(memory.ReadS32(Name("ml100").block, 400) == static_cast<std::int32_t>(0xFFFF12FFU));
    REQUIRE(memory.Write(Name("m3200"), 0.0).has_value());
    REQUIRE(memory.Read(Name("mb400")) == -2.0);
    REQUIRE(memory.Read(Name("m3201")) == 1.0);
    REQUIRE(memory.Write(Name("mw202"), 0x8000).has_value());
    REQUIRE(memory.Read(Name("mw202")) == -32768.0);
    REQUIRE(memory.Write(Name("mf102"), -0.25).has_value());
    REQUIRE(memory.Read(Name("mf102")) == -0.25);
    REQUIRE(memory.Read(Name("xl100")) == 0.0);
    REQUIRE(memory.Read(Name("fb0.dil100")) == 0.0);
}

TEST_CASE("Bits that are not a finite number read as the float 0")
{
    RelayMemory memory;
    for (const double bits : {double{0x7F800000}, double{0xFF800000}, double{0x7FC00000}})
    {
        REQUIRE(memory.Write(Name("ml1"), bits).has_value());
        REQUIRE(memory.Read(Name("mf1")) == 0.0);
    }
}

TEST_CASE("A value that its relay cannot hold is refused and changes nothing")
{
    RelayMemory memory;
    for (const auto& [name, value] :
         {std::pair{"m1", 2.0},
          std::pair{"m1", 0.5},
          std::pair{"mb1", 256.0},
          std::pair{"mb1", -129.0},
          std::pair{"mw1", 65536.0},
          std::pair{"ml1", 4294967296.0},
          std::pair{"ml1", 1e300},
          std::pair{"mf1", 1e300}})
    {
        INFO(name << ' ' << value);
        REQUIRE_FALSE(memory.Write(Name(name), value).has_value());
        REQUIRE(memory.Read(Name(name)) == 0.0);
    }
    REQUIRE(memory.Write(Name("ml1"), 4294967295.0).has_value());
    REQUIRE(memory.Read(Name("ml1")) == -1.0);
}
