#include "Catch.hpp"
#include "SeededRandom.hpp"
#include <acs/core/Uuid.hpp>

#include <regex>
#include <set>

using ACS::Core::MakeUUID;
using ACS::Testing::SeededRandom;

namespace
{

/// All bits are equal: shows which bits are fixed.
class ConstantRandom final : public ACS::Core::IRandom
{
    std::uint64_t _value;

public:
    explicit ConstantRandom(std::uint64_t value)
        : _value(value)
    {
    }

    [[nodiscard]] std::uint64_t GetNext() override
    {
        return _value;
    }
};

} // namespace

TEST_CASE("D-12 A generated UUID is canonical, lower case and of version 4")
{
    ConstantRandom zeros(0);
    ConstantRandom ones(~std::uint64_t{0});
    CHECK(MakeUUID(zeros) == "00000000-0000-4000-8000-000000000000");
    CHECK(MakeUUID(ones) == "ffffffff-ffff-4fff-bfff-ffffffffffff");

    const std::regex canonical("[0-9a-f]{8}-[0-9a-f]{4}-4[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}");
    SeededRandom random;
    for (int i = 0; i < 100; ++i)
    {
        CHECK(std::regex_match(MakeUUID(random), canonical));
    }
}

TEST_CASE("D-12 UUIDs differ from each other and depend only on the random source")
{
    SeededRandom random(7);
    SeededRandom twin(7);
    std::set<std::string> uuids;
    for (int i = 0; i < 1'000; ++i)
    {
        const std::string uuid = MakeUUID(random);
        CHECK(uuid == MakeUUID(twin));
        uuids.insert(uuid);
    }
    CHECK(uuids.size() == 1'000);
}
