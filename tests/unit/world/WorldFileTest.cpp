#include "world/WorldFile.hpp"

#include "Catch.hpp"
#include "TemporaryFolder.hpp"
#include "world/EWorldError.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <sys/file.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace)
using Sim::EWorldError;

namespace
{

/// A world file in a folder of its own: a cassette at A01.CP01.
class FloorFixture
{
    Testing::TemporaryFolder _folder;

public:
    FloorFixture()
    {
        Write(GetPath(), R"({"version":1,"carriers":{"CASSETTE_01":"A01.CP01"},"covers":{"A01.SET01":"closed"}})");
    }

    [[nodiscard]] std::string GetPath() const
    {
        return _folder.GetPath() / "world.json";
    }

    [[nodiscard]] std::string GetJournalPath() const
    {
        return GetPath() + ".journal";
    }

    static void Write(const std::string& path, const std::string& text, std::ios::openmode mode = std::ios::trunc)
    {
        std::ofstream(path, std::ios::binary | mode) << text;
    }

    [[nodiscard]] std::string ReadJournal() const
    {
        std::ifstream file(GetJournalPath(), std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    [[nodiscard]] std::unique_ptr<Sim::WorldFile> Open() const
    {
        auto world = Sim::WorldFile::Open(GetPath());
        INFO((world.has_value() ? "" : Core::Describe(world.error())));
        REQUIRE(world.has_value());
        return std::move(*world);
    }

    [[nodiscard]] std::string OpenForError() const
    {
        const auto world = Sim::WorldFile::Open(GetPath());
        REQUIRE_FALSE(world.has_value());
        return Core::Describe(world.error());
    }
};

const Sim::CarrierMoved PICK{"LR01", "CASSETTE_01", "A01.CP01", "LR01.CP01"};
const Sim::CarrierMoved DROP{"LR01", "CASSETTE_01", "LR01.CP01", "A01.CP01"};
const Sim::RobotDocked DOCK{"LR01", {"A01.CP01"}};

/// Moves the cassette back and forth until this robot has done the given number of moves; the world refuses a move that the
/// other robot has done already.
int ShuttleCarrier(const std::string& path, int moves)
{
    auto world = Sim::WorldFile::Open(path);
    int done = 0;
    while (world.has_value() && done < moves)
    {
        const bool bMoved = (*world)->Act(PICK).has_value() || (*world)->Act(DROP).has_value();
        done += bMoved ? 1 : 0;
    }
    return done;
}

/// Each carrier move of the journal begins where the one before it ended.
std::size_t CountChainedMoves(const std::vector<Sim::WorldEvent>& events)
{
    std::string place = "A01.CP01";
    std::size_t count = 0;
    for (const Sim::WorldEvent& event : events)
    {
        if (const auto* const moved = std::get_if<Sim::CarrierMoved>(&event); moved != nullptr)
        {
            REQUIRE(moved->from == place);
            place = moved->to;
            ++count;
        }
    }
    return count;
}

} // namespace

TEST_CASE("A process sees the events of the other ones in their order")
{
    const FloorFixture floor;
    const auto one = floor.Open();
    const auto other = floor.Open();
    CHECK(other->GetCarrierOrNull("A01.CP01") == "CASSETTE_01");
    CHECK(other->IsCovered("A01.SET01"));
    REQUIRE(one->Act(DOCK));
    REQUIRE(one->Act(PICK));
    CHECK(other->GetPlaceOrNull("CASSETTE_01") == "LR01.CP01");
    CHECK_FALSE(other->Act(PICK).has_value());
    REQUIRE(other->Act(DROP));
    REQUIRE(other->Act(Sim::MemoryPlaced{"A01.SET01.MP01", Sim::EMemory::Occupied}));
    CHECK(one->GetMemory("A01.SET01.MP01") == Sim::EMemory::Occupied);
    CHECK(one->GetCarrierOrNull("A01.CP01") == "CASSETTE_01");

    const auto mine = one->TakeEvents();
    CHECK(mine.size() == 4);
    CHECK((mine == other->TakeEvents()));
    CHECK(one->TakeEvents().empty());
}

TEST_CASE("The journal survives the processes")
{
    const FloorFixture floor;
    {
        const auto world = floor.Open();
        REQUIRE(world->Act(DOCK));
        REQUIRE(world->Act(PICK));
    }
    const auto world = floor.Open();
    CHECK(world->GetPlaceOrNull("CASSETTE_01") == "LR01.CP01");
    CHECK(world->TakeEvents().empty()); // earlier events are not returned
}

TEST_CASE("A refused event and one that changes nothing are not written")
{
    const FloorFixture floor;
    const auto world = floor.Open();
    CHECK_FALSE(world->Act(PICK).has_value());
    REQUIRE(world->Act(Sim::RobotDocked{"LR01", {}}));
    CHECK(floor.ReadJournal().empty());
    REQUIRE(world->Act(DOCK));
    REQUIRE(world->Act(DOCK));
    CHECK(floor.ReadJournal() == "{\"event\":\"RobotDocked\",\"robot\":\"LR01\",\"stations\":[\"A01.CP01\"]}\n");
}

TEST_CASE("Two threads with an object each move one carrier alternately")
{
    const FloorFixture floor;
    const auto world = floor.Open();
    REQUIRE(world->Act(DOCK));
    constexpr int MOVES = 300;
    std::atomic<int> done = 0;
    {
        const auto shuttle = [&]() {
            done += ShuttleCarrier(floor.GetPath(), MOVES);
        };
        std::thread one(shuttle);
        std::thread other(shuttle);
        one.join();
        other.join();
    }
    CHECK(done == 2 * MOVES);
    CHECK(CountChainedMoves(world->TakeEvents()) == 2 * MOVES);
}

TEST_CASE("Two processes move one carrier alternately, and one of them is killed")
{
    const FloorFixture floor;
    const auto world = floor.Open();
    REQUIRE(world->Act(DOCK));
    constexpr int MOVES = 300;
    const pid_t killed = ::fork();
    if (killed == 0)
    {
        ShuttleCarrier(floor.GetPath(), 1'000'000);
        ::_exit(1);
    }
    const pid_t other = ::fork();
    if (other == 0)
    {
        ::_exit(ShuttleCarrier(floor.GetPath(), MOVES) == MOVES ? 0 : 1);
    }
    CHECK(ShuttleCarrier(floor.GetPath(), MOVES) == MOVES);
    REQUIRE(::kill(killed, SIGKILL) == 0);
    int status = 1;
    REQUIRE(::waitpid(killed, &status, 0) == killed);
    REQUIRE(::waitpid(other, &status, 0) == other);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
    CHECK(CountChainedMoves(world->TakeEvents()) >= 2 * MOVES);
    CHECK(floor.Open() != nullptr);
}

TEST_CASE("A line without its end is ignored, and the next one replaces it")
{
    const FloorFixture floor;
    const auto before = floor.Open();
    REQUIRE(before->Act(DOCK));
    const std::string whole = floor.ReadJournal();
    FloorFixture::Write(
        floor.GetJournalPath(),
        R"({"event":"CarrierMoved","robot":"LR01","carrier":"CASSETTE_01","from":"A01.CP01","to":"LR01.CP01"})",
        std::ios::app);
    const auto after = floor.Open();
    CHECK(after->GetPlaceOrNull("CASSETTE_01") == "A01.CP01");
    CHECK(before->GetPlaceOrNull("CASSETTE_01") == "A01.CP01");
    REQUIRE(after->Act(Sim::CoverMoved{"LR01", "A01.SET01", false}).has_value() == false); // out of reach
    REQUIRE(after->Act(PICK));
    CHECK(before->GetPlaceOrNull("CASSETTE_01") == "LR01.CP01");
    const std::string journal = floor.ReadJournal();
    CHECK(journal.starts_with(whole));
    CHECK(std::ranges::count(journal, '\n') == 2);
    CHECK(journal.ends_with("}\n"));
}

TEST_CASE("A journal that does not match the world file is refused with its line")
{
    const FloorFixture floor;
    const std::string docked = R"({"event":"RobotDocked","robot":"LR01","stations":["A01.CP01"]})";
    FloorFixture::Write(floor.GetJournalPath(), docked + "\nno JSON\n");
    CHECK_THAT(floor.OpenForError(), Catch::Contains("world.json.journal:2") && Catch::Contains("JSON"));
    FloorFixture::Write(
        floor.GetJournalPath(),
        docked + "\n" + docked + "\n"
            + R"({"event":"CarrierMoved","robot":"LR01","carrier":"OTHER","from":"A01.CP01","to":"LR01.CP01"})" + "\n");
    CHECK_THAT(floor.OpenForError(), Catch::Contains("world.json.journal:3") && Catch::Contains("OTHER"));
    FloorFixture::Write(floor.GetJournalPath(), std::string(200'000, 'x'));
    CHECK_THAT(floor.OpenForError(), Catch::Contains("world.json.journal:1"));
}

TEST_CASE("Act fails if the journal is truncated, removed or damaged while it is in use")
{
    const FloorFixture floor;
    const auto world = floor.Open();
    REQUIRE(world->Act(DOCK));
    SECTION("truncated")
    {
        std::filesystem::resize_file(floor.GetJournalPath(), 3);
    }
    SECTION("removed")
    {
        std::filesystem::remove(floor.GetJournalPath());
    }
    SECTION("damaged")
    {
        FloorFixture::Write(floor.GetJournalPath(), "?\n", std::ios::app);
    }
    const Core::Result<void> acted = world->Act(PICK);
    REQUIRE_FALSE(acted.has_value());
    CHECK(acted.error().code == EWorldError::JournalFailed);
    CHECK(world->GetPlaceOrNull("CASSETTE_01") == "A01.CP01");
}

TEST_CASE("Act fails, without effect, while another process has the lock of the journal")
{
    const FloorFixture floor;
    const auto world = floor.Open();
    REQUIRE(world->Act(DOCK));
    const std::string before = floor.ReadJournal();
    const int other = ::open(floor.GetJournalPath().c_str(), O_RDWR | O_CLOEXEC); // NOLINT: the system's signature
    REQUIRE(other >= 0);
    REQUIRE(::flock(other, LOCK_EX) == 0);
    for (int attempt = 0; attempt < 3; ++attempt)
    {
        const Core::Result<void> acted = world->Act(PICK);
        REQUIRE_FALSE(acted.has_value());
        CHECK(acted.error().code == EWorldError::JournalFailed);
        CHECK_THAT(
            Core::Describe(acted.error()),
            Catch::Contains("world.json.journal: expected its lock within 2 s") && Catch::Contains("end that process"));
    }
    CHECK(world->GetPlaceOrNull("CASSETTE_01") == "A01.CP01");
    CHECK_FALSE(world->GetFailureOrNull().has_value()); // it can be read
    CHECK(floor.ReadJournal() == before);
    REQUIRE(::close(other) == 0);
    REQUIRE(world->Act(PICK));
    CHECK(world->GetPlaceOrNull("CASSETTE_01") == "LR01.CP01");
}

TEST_CASE("The failure of an unreadable journal has file and line, until it can be read again")
{
    const FloorFixture floor;
    const auto world = floor.Open();
    REQUIRE(world->Act(DOCK));
    CHECK_FALSE(world->GetFailureOrNull().has_value());
    const std::string whole = floor.ReadJournal();
    FloorFixture::Write(floor.GetJournalPath(), "?\n", std::ios::app);
    CHECK(world->TakeEvents().size() == 1);
    REQUIRE(world->GetFailureOrNull().has_value());
    CHECK_THAT(Core::Describe(*world->GetFailureOrNull()), Catch::Contains("world.json.journal:2: "));
    std::filesystem::resize_file(floor.GetJournalPath(), whole.size());
    CHECK(world->TakeEvents().empty());
    CHECK_FALSE(world->GetFailureOrNull().has_value());
}

TEST_CASE("An invalid or missing world file is refused with its name")
{
    const FloorFixture floor;
    FloorFixture::Write(floor.GetPath(), R"({"version":1,"carriers":{"TRAY_01":"A01"}})");
    CHECK_THAT(floor.OpenForError(), Catch::Contains("world.json: carriers.TRAY_01: expected a cassette port"));
    CHECK_FALSE(std::filesystem::exists(floor.GetJournalPath()));
    std::filesystem::remove(floor.GetPath());
    CHECK_THAT(floor.OpenForError(), Catch::Contains("world.json") && Catch::Contains("No such file"));
}

TEST_CASE("A journal that cannot be written is refused")
{
    const FloorFixture floor;
    std::filesystem::create_directory(floor.GetJournalPath());
    CHECK_THAT(floor.OpenForError(), Catch::Contains("world.json.journal"));
}
