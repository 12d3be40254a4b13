#include "programs/ProgramFile.hpp"

#include "Catch.hpp"

#include <string>
#include <vector>

using namespace ACS::OpenStreamSim; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using Texts = std::vector<std::string>;

namespace
{

Texts FindErrors(const std::string& text)
{
    const ProgramFile file = ProgramFile::ReadText(text, "p.toml");
    REQUIRE(file.programs.empty());
    return file.errors;
}

} // namespace

TEST_CASE("A program of the file has its time, its echo and its work")
{
    const ProgramFile file = ProgramFile::ReadText(
        R"([11]
duration = "3s"
from = ["A{ml106}.CP{ml107}.TP{ml108}"]
to = ["{robot}.TP{ml109}"]
[12]
fail = true
echo = "ml200"
[13]
echo = -1
cover = "close"
set = ["A{ml106}.SET{ml107}", "SET{ml107}"]
[9999]
echo = false
button = ["A{ml106}.SET{ml107}"]
)",
        "p.toml");
    REQUIRE(file.errors.empty());
    REQUIRE(file.programs.size() == 4);
    const ProgramSpec& load = file.programs.at(11);
    REQUIRE(load.duration == 3s);
    REQUIRE_FALSE(load.bFails);
    REQUIRE(load.echo == ParseRelayNameOrNull("ml105"));
    REQUIRE(std::get<TransferWork>(load.work).from.at(0).GetText() == "A{ml106}.CP{ml107}.TP{ml108}");
    REQUIRE(std::get<TransferWork>(load.work).to.at(0).GetText() == "{robot}.TP{ml109}");
    REQUIRE(file.programs.at(12).duration == 2s);
    REQUIRE(file.programs.at(12).bFails);
    REQUIRE(file.programs.at(12).echo == ParseRelayNameOrNull("ml200"));
    REQUIRE(std::holds_alternative<std::monostate>(file.programs.at(12).work));
    REQUIRE_FALSE(file.programs.at(13).echo.has_value());
    REQUIRE(std::get<CoverWork>(file.programs.at(13).work).bClose);
    REQUIRE(std::get<CoverWork>(file.programs.at(13).work).set.size() == 2);
    REQUIRE_FALSE(file.programs.at(9999).echo.has_value());
    REQUIRE(std::holds_alternative<ButtonWork>(file.programs.at(9999).work));
    REQUIRE(file.HasRobotName());
    REQUIRE_FALSE(ProgramFile::ReadText("[1]\nbutton = [\"A01.SET01\"]", "p.toml").HasRobotName());
}

TEST_CASE("Each error of the file is reported with file, line and key")
{
    REQUIRE(
        FindErrors("[11]\nfrom = [\"A{q1}.CP01\"]\nto = [\"{robot}.CP01\"]")
        == Texts{
            "p.toml:2: 11.from: expected {robot} or a relay that holds a whole number, such as {ml106}, found {q1}"});
    REQUIRE(
        FindErrors("[11]\nfrom = [\"A{ml1}.SET01\"]\nto = [\"{robot}.TP01\"]")
        == Texts{"p.toml:2: 11.from: expected a CP, TP or MP, found \"A{ml1}.SET01\""});
    REQUIRE(
        FindErrors("[11]\nfrom = [\"A01.CP01\"]") == Texts{"p.toml:1: 11.to: missing: from and to belong together"});
    REQUIRE(
        FindErrors("[11]\nfrom = [\"A01.CP01.TP01\"]\nto = [\"{robot}.TP01.MP01\"]")
        == Texts{"p.toml:3: 11.to: expected places of one kind in from and to: CP, TP or MP"});
    REQUIRE(
        FindErrors("[11]\n\necho = \"ml9999\"")
        == Texts{
            "p.toml:3: 11.echo: expected a relay that holds a whole number, such as 'ml105', or -1 for none, found \"ml9999\""});
    REQUIRE(
        FindErrors("[11]\necho = \"ml100\"")
        == Texts{
            "p.toml:2: 11.echo: expected a relay that a client writes, such as 'ml105', found \"ml100\": the program itself "
            "writes ml100 to ml104"});
    REQUIRE(
        FindErrors("[11]\nbutton = [\"A{ml1}.SET01\", \"A01.SET01\", \"A01.SET{ml1}\"]")
        == Texts{
            "p.toml:2: 11.button: expected \"A01.SET01\" at the end: it always applies, so the places after it never do"});
    for (const char* text :
         {"[0]",
          "[11]\necho = \"ml104\"",
          "[11]\necho = \"mb419\"",
          "[11]\necho = \"mw200\"",
          "[11]\necho = \"m3200\"",
          "[11]\nbutton = [\"A01.SET01\", \"A01.SET01\"]",
          "[10000]",
          "[x]",
          "[011]",
          "[11]\nfrom = []\nto = [\"{robot}.TP01\"]",
          "[11]\nfrom = \"A01.CP01\"\nto = [\"A01.CP01\"]",
          "[11]\ncover = \"shut\"\nset = [\"A01.SET01\"]",
          "[11]\ncover = \"open\"",
          "[11]\nset = [\"A01.SET01\"]",
          "[11]\ncover = \"open\"\nset = [\"A01.CP01\"]",
          "[11]\nbutton = [\"{robot}.TP01\"]",
          "[11]\nduration = \"0s\"",
          "[11]\nduration = 3",
          "[11]\nfail = 1",
          "[11]\necho = 0",
          "[11]\necho = true",
          "[11]\nform = []",
          "11 = 1",
          "[11]\nbutton = [\"A01.SET01\"]\ncover = \"open\"\nset = [\"A01.SET01\"]",
          "[11"})
    {
        INFO(text);
        const Texts errors = FindErrors(text);
        REQUIRE(errors.size() == 1);
        REQUIRE(errors.front().starts_with("p.toml:"));
    }
}

TEST_CASE("Relays beside the words that programs write can be echoed")
{
    for (const char* echo : {"ml99", "mb399", "mb420", "ml105", "m3199", "sl100", "fb0.dil100"})
    {
        INFO(echo);
        REQUIRE(ProgramFile::ReadText(std::string("[11]\necho = \"") + echo + "\"", "p.toml").errors.empty());
    }
}

TEST_CASE("A missing file is one error with its name")
{
    const ProgramFile file = ProgramFile::Read("/nowhere/programs.toml");
    REQUIRE(file.errors.size() == 1);
    REQUIRE(file.errors.front().find("/nowhere/programs.toml") != std::string::npos);
}
