#include "StoreFolder.hpp"
#include <acs/plan/EPlanningError.hpp>

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using namespace ACS::Planning;       // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Planning::Test; // NOLINT(google-build-using-namespace)
using namespace ACS;                 // NOLINT(google-build-using-namespace)

namespace
{

namespace Files = std::filesystem;

std::string ReadBytes(const std::string& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// The files of a program that is killed while it has the store open.
void CopyAsKilled(const std::string& directory, const std::string& copy)
{
    MakeDirectory(copy);
    for (const char* name : {"acsd.db", "acsd.db-wal", "generation"})
    {
        Files::copy_file(Files::path(directory) / name, Files::path(copy) / name);
    }
    ForgetIdentity(copy);
}

/// A few transactions with more pages than SQLite keeps in a log.
void WriteMuch(SqlitePlanStore& store)
{
    constexpr int TRANSACTIONS = 80;
    const std::string longText(80'000, 'C');
    for (int count = 0; count < TRANSACTIONS; ++count)
    {
        REQUIRE(store.Append({{CarriersChanged{"LR01", {longText}}}}).has_value());
    }
    REQUIRE(store.Append({{CarriersChanged{"LR01", {std::nullopt}}}}).has_value());
}

void RequireRefused(const std::string& directory, const std::string& found)
{
    const std::string log = GetLog(directory);
    const std::string text = Files::exists(log) ? ReadBytes(log) : std::string();
    const auto refused = SqlitePlanStore::Open(directory);
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().code == EPlanningError::StoreCorrupt);
    INFO(Core::Describe(refused.error()));
    CHECK(Contains(Core::Describe(refused.error()), "with its log " + log + "; put these files back"));
    CHECK(Contains(Core::Describe(refused.error()), "run acsd store accept " + directory));
    CHECK(Contains(Core::Describe(refused.error()), found));
    CHECK_FALSE(SqlitePlanStore::Inspect(directory).has_value());
    CHECK((Files::exists(log) ? ReadBytes(log) : std::string()) == text);
}

void FlipBit(const std::string& file, std::size_t offset)
{
    std::string bytes = ReadBytes(file);
    bytes.at(offset) = static_cast<char>(bytes.at(offset) ^ 1);
    std::ofstream(file, std::ios::binary) << bytes;
}

constexpr const char* WITHOUT_LOG = "found a database that was not closed, without its log";
constexpr const char* DAMAGED_LOG = "found a database that was not closed, with a damaged log";
constexpr const char* OTHER_GENERATION = "found a database of another generation";

/// More than 10 MiB.
void WriteLargeLog(SqlitePlanStore& store)
{
    for (const char letter : {'C', 'D', 'E'}) // SQLite does not write a page again that has not changed
    {
        REQUIRE(store.Append({{CarriersChanged{"LR01", {std::string(3'600'000, letter)}}}}).has_value());
    }
}

} // namespace

TEST_CASE("Store: a log that another program keeps from being merged is reported, and gets small when it has ended")
{
    constexpr std::uint64_t LARGE = 8ULL * 1024 * 1024;
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    const auto store = OpenStore(directory);
    REQUIRE(store->Append(MakeBatch("LR01")).has_value());
    StoreLog log = store->CheckLog();
    CHECK(log.path == GetDatabase(directory));
    CHECK(log.bytes == Files::file_size(GetLog(directory)));
    CHECK(log.freeBytes > 0);
    CHECK(log.blockReason.empty());

    std::optional<SQLite::Database> reader(std::in_place, GetDatabase(directory), SQLite::OPEN_READONLY);
    reader->exec("BEGIN");
    if (GENERATE(false, true)) // a log that is merged completely: the reader then uses the database file only
    {
        WriteLargeLog(*store);
        REQUIRE(store->CheckLog().blockReason.empty());
    }
    CHECK(reader->execAndGet("SELECT count(*) FROM plans").getInt() == 0); // from here on it keeps this state
    WriteLargeLog(*store);
    REQUIRE(store->Append(MakeBatch("LR02")).has_value());
    log = store->CheckLog();
    CHECK(log.bytes > LARGE);
    CHECK(Contains(log.blockReason, "Find it with fuser -v " + GetDatabase(directory) + " and end it"));
    REQUIRE(store->Append(MakeBatch("CR01")).has_value()); // it can still be written
    CHECK_FALSE(store->CheckLog().blockReason.empty());

    reader.reset();
    CHECK(store->CheckLog().blockReason.empty());
    REQUIRE(store->Append(MakeBatch("CR02")).has_value());
    CHECK(store->CheckLog().bytes <= LARGE);
    // A crash at this moment leaves a store that a start accepts.
    CopyAsKilled(directory, folder.GetStore("copy"));
    OpenStore(folder.GetStore("copy"));
}

TEST_CASE("Store: a large log that no program reads is merged by a check")
{
    const StoreFolder folder;
    const auto store = OpenStore(folder.GetStore());
    REQUIRE(store->Append(MakeBatch("LR01")).has_value());
    WriteLargeLog(*store);
    CHECK(store->CheckLog().blockReason.empty());
    CopyAsKilled(folder.GetStore(), folder.GetStore("copy"));
    CHECK(LoadRobots(*OpenStore(folder.GetStore("copy"))) == std::vector<std::string>{"LR01"});
}

TEST_CASE("Store: a log without its database is not deleted for a new database")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    const std::string lost = folder.GetStore("lost");
    const std::unique_ptr<SqlitePlanStore> store = OpenStore(directory);
    REQUIRE(store->Append(MakeBatch("LR01")).has_value());
    CopyAsKilled(directory, lost);
    Files::remove(GetDatabase(lost));
    if (GENERATE(false, true))
    {
        std::ofstream(GetDatabase(lost)).flush();
    }
    for (const Core::Error& error : {SqlitePlanStore::Open(lost).error(), SqlitePlanStore::Inspect(lost).error()})
    {
        CHECK(error.code == EPlanningError::StoreCorrupt);
        CHECK(Contains(Core::Describe(error), GetLog(lost) + " belongs; put that file back"));
    }
    CHECK(Files::file_size(GetLog(lost)) == Files::file_size(GetLog(directory)));
    Files::copy_file(GetDatabase(directory), GetDatabase(lost), Files::copy_options::overwrite_existing);
    CHECK(LoadRobots(*OpenStore(lost)) == std::vector<std::string>{"LR01"});
}

TEST_CASE("Store: a store that is killed directly after its start is opened again")
{
    const StoreFolder folder;
    const auto store = OpenStore(folder.GetStore());
    CopyAsKilled(folder.GetStore(), folder.GetStore("copy"));
    OpenStore(folder.GetStore("copy"));
}

TEST_CASE("Store: a store whose log could not be merged at its start is refused without it")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    const std::string copy = folder.GetStore("copy");
    OpenStore(directory);
    SQLite::Database reader(GetDatabase(directory), SQLite::OPEN_READWRITE);
    reader.exec("BEGIN");
    reader.exec("SELECT * FROM plans");
    const auto store = OpenStore(directory);
    REQUIRE(store->Append(MakeBatch("LR01")).has_value());
    CopyAsKilled(directory, copy);
    const std::string log = ReadBytes(GetLog(copy));
    Files::remove(GetLog(copy));
    RequireRefused(copy, OTHER_GENERATION);
    std::ofstream(GetLog(copy), std::ios::binary) << log;
    CHECK(LoadRobots(*OpenStore(copy)) == std::vector<std::string>{"LR01"});
}

TEST_CASE("Store: a store that was not closed is opened with its log, and refused without it")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    const std::string copy = folder.GetStore("copy");
    const auto store = OpenStore(directory);
    REQUIRE(store->Append(MakeBatch("CR01")).has_value());
    const std::string history = GENERATE(
        as<std::string>(),
        "never merged",
        "merged by the store",
        "merged by another program",
        "read by another program while the store tries to merge it");
    INFO("The log was " << history);
    if (history == "merged by the store")
    {
        WriteMuch(*store);
        CHECK(SqlitePlanStore::Inspect(directory).has_value());
        CHECK(Files::file_size(GetLog(directory)) < 5'000'000); // 80 x 80 kB were written
    }
    else if (history == "merged by another program")
    {
        SQLite::Database(GetDatabase(directory), SQLite::OPEN_READWRITE).exec("PRAGMA wal_checkpoint(TRUNCATE)");
    }
    else if (history != "never merged")
    {
        SQLite::Database reader(GetDatabase(directory), SQLite::OPEN_READONLY);
        reader.exec("BEGIN; SELECT * FROM plans");
        WriteMuch(*store);
    }
    REQUIRE(store->Append(MakeBatch("LR03")).has_value());
    for (const char* const carrierID : {"C1", "C2"})
    {
        REQUIRE(store->Append({{CarriersChanged{"LR03", {carrierID}}}}).has_value());
    }
    CopyAsKilled(directory, copy);
    SECTION("The log is missing")
    {
        Files::remove(GetLog(copy));
        RequireRefused(copy, WITHOUT_LOG);
        CHECK_FALSE(AcceptStore(copy)->GetOrigin().bNew);
    }
    SECTION("The log is empty")
    {
        Files::resize_file(GetLog(copy), 0);
        RequireRefused(copy, WITHOUT_LOG);
    }
    SECTION("The log has only zeros, as after a power loss")
    {
        const std::string zeros(Files::file_size(GetLog(copy)), '\0');
        std::ofstream(GetLog(copy), std::ios::binary) << zeros;
        RequireRefused(copy, DAMAGED_LOG);
    }
    SECTION("The log is cut in its first frame")
    {
        Files::resize_file(GetLog(copy), 100);
        RequireRefused(copy, DAMAGED_LOG);
    }
    SECTION("One bit of the first frame of the log is wrong")
    {
        FlipBit(GetLog(copy), 156);
        RequireRefused(copy, DAMAGED_LOG);
        CHECK_FALSE(AcceptStore(copy)->GetOrigin().bNew);
    }
    SECTION("Another program has merged and deleted the log")
    {
        SQLite::Database(GetDatabase(copy), SQLite::OPEN_READWRITE).exec("VACUUM");
        REQUIRE_FALSE(Files::exists(GetLog(copy)));
        RequireRefused(copy, WITHOUT_LOG);
        CHECK(LoadRobots(*AcceptStore(copy)).back() == "LR03");
    }
    SECTION("It is there")
    {
        CHECK(LoadRobots(*OpenStore(copy)).back() == "LR03");
    }
}

TEST_CASE("Store: a transaction that a crash has interrupted is ignored, and those before it are kept")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    const std::string copy = folder.GetStore("copy");
    const std::unique_ptr<SqlitePlanStore> store = OpenStore(directory);
    REQUIRE(store->Append(MakeBatch("LR02")).has_value());
    const std::uintmax_t before = Files::file_size(GetLog(directory));
    REQUIRE(store->Append(MakeBatch("LR03")).has_value());
    CopyAsKilled(directory, copy);
    SECTION("Its first page is not on the disk")
    {
        FlipBit(GetLog(copy), before + 100);
    }
    SECTION("It is cut")
    {
        Files::resize_file(GetLog(copy), before + 100);
    }
    CHECK(SqlitePlanStore::Inspect(copy).has_value());
    CHECK(LoadRobots(*OpenStore(copy)).back() == "LR02");
}

TEST_CASE("Store: a store that was closed while another program read it is opened after that program has ended")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    const auto readWhileClosing = [&directory](const char* first, const char* second) {
        auto store = OpenStore(directory);
        REQUIRE(store->Append(MakeBatch("LR01")).has_value());
        SQLite::Database reader(GetDatabase(directory), SQLite::OPEN_READWRITE);
        reader.exec(first);
        reader.exec("SELECT * FROM plans");
        REQUIRE(store->Append(MakeBatch("LR02")).has_value());
        store.reset();
        reader.exec(second);
    };
    SECTION("It reads now and then")
    {
        readWhileClosing("SELECT 1", "SELECT 1");
    }
    SECTION("It is in a transaction")
    {
        readWhileClosing("BEGIN", "ROLLBACK");
    }
    REQUIRE_FALSE(Files::exists(GetLog(directory)));
    CHECK(LoadRobots(*OpenStore(directory)) == std::vector<std::string>{"LR01", "LR02"});
}

TEST_CASE("Store: an older database in the place of the one that was used last is refused until it is accepted")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    const std::string copy = folder.GetStore("copy");
    const std::string backup = folder.GetStore("backup.db");
    OpenStore(directory);
    Files::copy_file(GetDatabase(directory), backup);
    const auto store = OpenStore(directory);
    REQUIRE(store->Append(MakeBatch("LR01")).has_value());
    CopyAsKilled(directory, copy);
    SECTION("Not closed")
    {
        Files::remove(GetLog(copy));
    }
    SECTION("Closed")
    {
        OpenStore(copy);
    }
    Files::copy_file(backup, GetDatabase(copy), Files::copy_options::overwrite_existing);
    RequireRefused(copy, OTHER_GENERATION);
    CHECK(LoadRobots(*AcceptStore(copy)).empty());
}

TEST_CASE("Store: a copy of an open store by another program is a store in a directory of its own, once accepted")
{
    const StoreFolder folder;
    const std::string backup = folder.GetStore("backup");
    const auto store = OpenStore(folder.GetStore());
    REQUIRE(store->Append(MakeBatch("LR01")).has_value());
    MakeDirectory(backup);
    SQLite::Database(GetDatabase(folder.GetStore()), SQLite::OPEN_READONLY)
        .exec("VACUUM INTO '" + GetDatabase(backup) + "'");
    CHECK(LoadRobots(*AcceptStore(backup)) == std::vector<std::string>{"LR01"});
}

TEST_CASE("Store: a start that is killed before it has stored its generation is repeated")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    REQUIRE(OpenStore(directory)->Append(MakeBatch("LR01")).has_value());
    const std::string previous = ReadBytes(GetGeneration(directory));
    std::ofstream(GetGeneration(directory)) << "0123456789abcdef\n" << previous;
    CHECK(SqlitePlanStore::Inspect(directory).has_value());
    CHECK(LoadRobots(*OpenStore(directory)) == std::vector<std::string>{"LR01"});
    const std::string next = ReadBytes(GetGeneration(directory));
    CHECK(std::ranges::count(next, '\n') == 1);
    CHECK(next != previous);
    for (const char* text : {"", "0123456789abcdef\n"})
    {
        std::ofstream(GetGeneration(directory)) << text;
        RequireRefused(directory, OTHER_GENERATION);
    }
}

TEST_CASE("Store: a new database in the place of one that was moved away is opened again after a crash")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    const std::string killed = folder.GetStore("killed");
    MakeDirectory(directory);
    std::ofstream(GetGeneration(directory)) << "0123456789abcdef\n";
    const auto store = OpenStore(directory);
    CHECK(store->GetOrigin().bNew);
    REQUIRE(store->Append(MakeBatch("LR01")).has_value());
    CopyAsKilled(directory, killed);
    CHECK(LoadRobots(*OpenStore(killed)) == std::vector<std::string>{"LR01"});
}

TEST_CASE("Store: a store that was not closed and is refused is left unchanged, with its log")
{
    const StoreFolder folder;
    const std::string copy = folder.GetStore("copy");
    {
        const auto store = OpenStore(folder.GetStore());
        REQUIRE(store->Append(MakeBatch("LR01")).has_value());
        SQLite::Database(GetDatabase(folder.GetStore()), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 99");
        CopyAsKilled(folder.GetStore(), copy);
    }
    const std::string before = ReadBytes(GetDatabase(copy));
    const std::string log = ReadBytes(GetLog(copy));
    const auto refused = SqlitePlanStore::Open(copy);
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().code == EPlanningError::StoreTooNew);
    CHECK((ReadBytes(GetDatabase(copy)) == before)); // double brackets: a failure does not print both
    CHECK((ReadBytes(GetLog(copy)) == log));
}

TEST_CASE("Store: a copy of the database alone, also of an open store, is a store once it is accepted")
{
    const StoreFolder folder;
    const std::string copy = folder.GetStore("copy");
    const auto store = OpenStore(folder.GetStore());
    MakeDirectory(copy);
    Files::copy_file(GetDatabase(folder.GetStore()), GetDatabase(copy));
    CHECK_FALSE(AcceptStore(copy)->GetOrigin().bNew);
}
