#!/usr/bin/env python3
"""Plants one violation after another in an otherwise right tree, and requires that scripts/check_api.py, scripts/check_layers.py,
scripts/check_files.py, scripts/check_members.py, scripts/check_references.py, scripts/check_sizes.py, scripts/check_translations.py
and scripts/check_words.py report it at its line; the tree without it must pass."""

import os
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "scripts"))
sys.dont_write_bytecode = True
import check_api  # noqa: E402
import check_files  # noqa: E402
import check_layers  # noqa: E402
import check_members  # noqa: E402
import check_references  # noqa: E402
import check_sizes  # noqa: E402
import check_translations  # noqa: E402
import check_words  # noqa: E402
from translations import make_mark  # noqa: E402

CHECKS = {"api": check_api, "layers": check_layers, "files": check_files, "members": check_members,
          "references": check_references, "sizes": check_sizes,
          "translations": check_translations, "words": check_words}

RIGHT = {
    "libacs-core/include/acs/core/Location.hpp": "#pragma once\n#include <fmt/core.h>\nclass Location\n{\n};\n",
    "libacs-core/net/include/acs/net/Listener.hpp": "#pragma once\n#include <boost/asio/ip/tcp.hpp>\n",
    "libacs-core/json/include/acs/json/JsonReader.hpp": "#pragma once\n#include <rapidjson/reader.h>\n",
    "libacs-protocol/include/acs/protocol/Codec.hpp": "#pragma once\n#include <acs/core/Location.hpp>\n",
    "libacs-protocol/src/codec/Codec.cpp": "#include <acs/json/JsonReader.hpp>\n// steady_clock::now() is a comment\n",
    "libacs-protocol/src/PendingRequests.hpp": "#pragma once\n#include <vector>\n",
    "libacs-protocol/beast/include/acs/protocol_beast/Client.hpp":
        "#pragma once\n#include <acs/protocol/Codec.hpp>\n#include <boost/asio/any_io_executor.hpp>\n",
    "libacs-protocol/beast/src/Client.cpp": "#include <boost/beast/websocket.hpp>\n#include <thread>\n",
    "libacs-protocol/c/include/acs/c/codec.h": "struct codec;\n",
    "libacs-protocol/c/src/Codec.cpp":
        "#include <acs/c/codec.h>\n#include <acs/protocol/Codec.hpp>\nstd::random_device device;\n",
    "libvda5050/include/acs/vda5050/Header.hpp": "#pragma once\n#include <acs/core/Location.hpp>\n",
    "libvda5050/mosquitto/src/Link.cpp": "#include <acs/vda5050/Header.hpp>\n#include <mosquitto.h>\n",
    "libplan/src/traffic/Router.hpp": "#pragma once\n#include \"../engine/EngineFacts.hpp\"\n",
    "libplan/src/engine/EngineFacts.hpp": "#pragma once\nclass EngineFacts\n{\n};\n",
    "libplan/json/include/acs/plan_json/Fields.hpp": "#pragma once\n#include <acs/json/JsonReader.hpp>\n",
    "libplan/src/codec/Codec.cpp": "#include <acs/plan_json/Fields.hpp>\n",
    "apps/acsd/Record.cpp": "#include <acs/plan_json/Fields.hpp>\n",
    "libplan/sqlite/src/Store.cpp": "#include <SQLiteCpp/Database.h>\n",
    "libplan/adapter-test/include/acs/adapter_test/Finding.hpp": "#pragma once\n#include <acs/core/Location.hpp>\n",
    "apps/common/ConfigReader.hpp": "#pragma once\n#include <acs/core/Location.hpp>\n",
    "apps/acsd/Acsd.hpp": "#pragma once\n#include \"../common/ConfigReader.hpp\"\n#include <acs/protocol/Codec.hpp>\n",
    "apps/acsd/include/acs/acsd/IRobot.hpp": "#pragma once\n#include <acs/core/Location.hpp>\n",
    "apps/acsd/main.cpp": "#include \"Acsd.hpp\"\n" * 60,
    "apps/vda-sim/VirtualVehicle.hpp": "#pragma once\n#include \"../world/World.hpp\"\n",
    "apps/world/World.hpp": "#pragma once\n#include <acs/core/Location.hpp>\n",
    "tests/support/ManualClock.hpp": "#pragma once\n#include <acs/core/Location.hpp>\n",
    "tests/unit/core/LocationTest.cpp": "#include \"ManualClock.hpp\"\nTEST_CASE(\"one\")\n{\n}\n",
    "examples/e01_locations.cpp": "#include <acs/core/Location.hpp>\n",
    "tests/install/consumer_Core.cpp": "// Links the library alone.\nint main()\n{\n}\n",
    "libplan/src/engine/EngineAlarm.hpp": "#pragma once\ninline constexpr std::string_view ALARM_STORE = \"ACS-1005\";\n",
    "apps/acsd/AcsdMetrics.cpp": "constexpr const char* LINK = \"acsd_link_up\";\n",
    "docs/reference/alarms.md": "| Code | Level |\n|---|---|\n| `ACS-1005` | as `ACS-1004` |\n",
    "docs/reference/metrics.md": "| Metric |\n|---|\n| `acsd_link_up{link}` |\n",
    "docs/guide.md": "# Guide\n\n## Parking positions\n\nSee [above](#guide), [the other](reference/keys.md#the-keys) and "
                     "[elsewhere](https://example.org/#none).\n",
    "docs/reference/keys.md": "# Reference\n\n## The keys\n\n`look at` and `[1](2)` are code.\n\n```\nnobody gives up\n# Not a heading\n"
                              "```\n\n    so many\n\n[Guide](../guide.md#parking-positions)\n",
}

ALARMS, KOREAN_ALARMS = "docs/reference/alarms.md", "docs/reference/ko/alarms.md"
MARK = make_mark(ALARMS, RIGHT[ALARMS])
KOREAN = "| 코드 | 레벨 |\n|---|---|\n| `ACS-1005` | `ACS-1004`와 같음 |\n"
RIGHT[KOREAN_ALARMS] = f"{MARK}\n{KOREAN}"
RIGHT["README.md"] = "# Robots\n"
RIGHT["README.ko.md"] = f"{make_mark('README.md', RIGHT['README.md'])}\n# 로봇\n[English](README.md)\n"

# check, file, content, line that must be named, what the sentence must hold
PLANTED = [
    ("api", "libplan/include/acs/plan/Box.hpp", "#pragma once\nclass Box final : public IBox\n{\npublic:\n    Box();\n};\n", 2,
     "mark it with ACS_API"),
    ("api", "libplan/include/acs/plan/IBox.hpp", "#pragma once\nclass IBox\n{\n    virtual ~IBox() = default;\n};\n", 2, "virtual"),
    ("api", "libplan/include/acs/plan/Box.hpp",
     "#pragma once\nnamespace ACS::Planning\n{\n\nclass ACS_API Box\n{\n    class Impl;\n    void Run();\n};\n\n}\n", 7, "ACS_HIDDEN"),
    ("api", "apps/acsd/include/acs/acsd/Run.hpp", "#pragma once\n[[nodiscard]] int Run(int count = Get({1}));\n", 2, "this function"),
    ("api", "libplan/include/acs/plan/Box.hpp", "#pragma once\nextern template void Box::Run<int>(int size);\n", 2, "this function"),
    ("layers", "libacs-core/src/Location.cpp", "#include <string>\n#include <boost/asio.hpp>\n", 2, "layer 'core'"),
    ("layers", "libacs-core/src/Location.cpp", "#include <rapidjson/document.h>\n", 1, "layer 'core'"),
    ("layers", "libacs-core/src/Location.cpp", "#include <mutex>\n", 1, "pure"),
    ("layers", "libacs-core/src/Location.cpp", "auto now = std::chrono::steady_clock::now();\n", 1, "clock"),
    ("layers", "libacs-core/src/Location.cpp", "std::random_device device;\n", 1, "random"),
    ("layers", "libacs-core/src/Location.cpp", "#include <acs/protocol/Codec.hpp>\n", 1, "above"),
    ("layers", "libacs-core/include/acs/core/Plan.hpp", "#pragma once\n#include <acs/json/JsonReader.hpp>\n", 2, "internal"),
    ("layers", "libacs-protocol/include/acs/protocol/Bad.hpp", "#pragma once\n#include <acs/json/JsonReader.hpp>\n", 2,
     "internal"),
    ("layers", "libacs-protocol/src/Session.hpp", "#pragma once\n#include <acs/json/JsonReader.hpp>\n", 2, "internal"),
    ("layers", "libacs-protocol/src/Session.cpp", "#include <rapidjson/reader.h>\n", 1, "layer 'protocol'"),
    ("layers", "libacs-protocol/src/Session.cpp", "#include <acs/vda5050/Header.hpp>\n", 1, "another library"),
    ("layers", "libacs-protocol/src/Session.cpp", "#include <acs/protocol_beast/Client.hpp>\n", 1, "another library"),
    ("layers", "libacs-protocol/src/Session.cpp", "#include \"../../apps/acsd/Acsd.hpp\"\n", 1, "program"),
    ("layers", "libacs-protocol/src/Session.cpp", "#include <acs/c/codec.h>\n", 1, "layer 'protocol'"),
    ("layers", "libacs-protocol/c/src/Handle.cpp", "#include <acs/vda5050/Header.hpp>\n", 1, "out of reach of a C interface"),
    ("layers", "libacs-protocol/c/src/Handle.cpp", "#include <mutex>\n", 1, "pure"),
    ("layers", "libacs-protocol/c/src/Handle.cpp", "auto now = std::chrono::steady_clock::now();\n", 1, "clock"),
    ("layers", "libvda5050/src/Session.cpp", "#include <boost/asio/steady_timer.hpp>\n", 1, "layer 'vda5050'"),
    ("layers", "libvda5050/src/Session.cpp", "#include <mosquitto.h>\n", 1, "layer 'vda5050'"),
    ("layers", "libvda5050/src/Session.cpp", "\n/* two\nlines */ auto now = system_clock :: now();\n", 3, "clock"),
    ("layers", "libopenstream/src/Framer.cpp", "#include <thread>\n", 1, "pure"),
    ("layers", "libopenstream/src/Framer.cpp", "#include <filesystem>\n", 1, "pure"),
    ("layers", "libopenstream/src/Framer.cpp", "#include <sys/socket.h>\n", 1, "layer 'openstream'"),
    ("layers", "libplan/src/Engine.cpp", "#include <sqlite3.h>\n", 1, "layer 'plan'"),
    ("layers", "libplan/src/Engine.cpp", "#include <acs/protocol/Codec.hpp>\n", 1, "another library"),
    ("layers", "libplan/src/Engine.cpp", "#include <acs/adapter_test/Finding.hpp>\n", 1, "another library"),
    ("layers", "libplan/src/Engine.hpp", "#pragma once\n#include <acs/plan_json/Fields.hpp>\n", 2, "internal"),
    ("layers", "apps/acsctl/Bad.cpp", "#include <acs/plan_json/Fields.hpp>\n", 1, "internal"),
    ("layers", "apps/acsd/Bad.hpp", "#pragma once\n#include <acs/plan_json/Fields.hpp>\n", 2, "internal"),
    ("layers", "libplan/json/include/acs/plan_json/Bad.hpp", "#pragma once\n#include <acs/protocol/Codec.hpp>\n", 2, "above"),
    ("layers", "libplan/adapter-test/src/Bad.cpp", "#include <acs/protocol/Codec.hpp>\n", 1, "out of reach"),
    ("layers", "libplan/adapter-test/src/Bad.cpp", "auto now = std::chrono::steady_clock::now();\n", 1, "clock"),
    ("layers", "libacs-protocol/beast/src/Bad.cpp", "#include <acs/vda5050/Header.hpp>\n", 1, "out of reach"),
    ("layers", "libacs-protocol/beast/src/Bad.cpp", "#include <acs/json/JsonReader.hpp>\n", 1, "internal"),
    ("layers", "libacs-protocol/src/Bad.cpp", "#include <acs/net/Listener.hpp>\n", 1, "internal"),
    ("layers", "libacs-protocol/beast/include/acs/protocol_beast/Bad.hpp", "#pragma once\n#include <acs/net/Listener.hpp>\n",
     2, "internal"),
    ("layers", "libacs-protocol/beast/src/Bad.cpp", "#include <mosquitto.h>\n", 1, "layer 'protocol_beast'"),
    ("layers", "libvda5050/mosquitto/src/Bad.cpp", "#include <boost/beast/core.hpp>\n", 1, "layer 'vda5050_mosquitto'"),
    ("layers", "libopenstream/asio/src/Bad.cpp", "#include <SQLiteCpp/Database.h>\n", 1, "layer 'openstream_asio'"),
    ("layers", "libplan/sqlite/src/Bad.cpp", "#include <boost/asio.hpp>\n", 1, "layer 'plan_sqlite'"),
    ("layers", "libacs-protocol/beast/include/acs/protocol_beast/Bad.hpp",
     "#pragma once\n#include <boost/beast/core.hpp>\n", 2, "public header"),
    ("layers", "libacs-protocol/beast/src/Bad.cpp", "#include \"ManualClock.hpp\"\n", 1, "tests"),
    ("layers", "apps/acsd/Bad.cpp", "#include \"../../tests/support/ManualClock.hpp\"\n", 1, "tests"),
    ("layers", "apps/acsd/Bad.cpp", "#include \"../vda-sim/VirtualVehicle.hpp\"\n", 1, "program"),
    ("layers", "apps/acsd/Bad.cpp", "#include \"../world/World.hpp\"\n", 1, "program"),
    ("layers", "apps/common/Bad.cpp", "#include \"../acsd/Acsd.hpp\"\n", 1, "program"),
    ("layers", "apps/acsd/Bad.cpp", "void Wait()\n{\n    std::this_thread::sleep_for(1s);\n}\n", 3, "sleeps"),
    ("layers", "apps/acsd/main.cpp", "\n" * 61, 61, "main.cpp"),
    ("layers", "apps/acsd/CMakeLists.txt", "add_library(one)\ntarget_link_libraries(one acs_test_support)\n", 2, "tests"),
    ("layers", "examples/e02_json.cpp", "#include <acs/json/JsonReader.hpp>\n", 1, "internal"),
    ("layers", "examples/e03_acsd.cpp", "#include \"../apps/acsd/Acsd.hpp\"\n", 1, "program"),
    ("layers", "apps/acsd/include/acs/acsd/Bad.hpp", "#pragma once\n#include \"common/ConfigReader.hpp\"\n", 2, "hidden"),
    ("layers", "apps/acsd/include/acs/acsd/Bad.hpp", "#pragma once\n#include <acs/protocol/Codec.hpp>\n", 2, "hidden"),
    ("layers", "apps/acsd/include/acs/acsd/Bad.hpp", "#pragma once\n#include <boost/asio/post.hpp>\n", 2, "layer 'drivers'"),
    ("layers", "apps/vda-sim/Bad.cpp", "#include <acs/acsd/IRobot.hpp>\n", 1, "only apps/acsd"),
    ("layers", "libplan/src/Bad.cpp", "#include <acs/acsd/IRobot.hpp>\n", 1, "only apps/acsd"),
    ("layers", "tests/support/Bad.hpp", "#pragma once\n#include <acs/protocol_beast/Client.hpp>\n", 2, "tests/support"),
    ("files", "libplan/src/Engine.hpp", "class Engine\n{\n};\n", 1, "#pragma once"),
    ("files", "libplan/src/engine.hpp", "#pragma once\nclass engine\n{\n};\n", 1, "PascalCase"),
    ("files", "libplan/src/plan_engine.cpp", "int one;\n", 1, "PascalCase"),
    ("files", "libplan/src/Engine.hpp", "#pragma once\n\nclass PlanEngine\n{\n};\n", 3, "PlanEngine.hpp"),
    ("files", "libplan/src/Job.hpp", "#pragma once\nstruct Task\n{\n};\n", 1, "Task.hpp"),
    ("files", "libplan/src/Engine.hpp", "#pragma once\nclass Engine\n{\n};\n\nclass Store final\n{\n};\n", 6, "second class"),
    ("files", "libplan/src/Engine.cc", "int one;\n", 1, ".cpp"),
    ("files", "tests/unit/plan/Engine.cpp", "TEST_CASE(\"one\")\n{\n}\n", 1, "Test.cpp"),
    ("files", "libplan/src/Engine.cpp", "int one;\nint two;\r\n", 2, "LF"),
    ("files", "libplan/src/Engine.cpp", "int one;\nint two;", 2, "last line"),
    ("files", "libplan/src/Engine.cpp", "int one;\n// TO" "DO: more\n", 2, "unfinished"),
    ("files", "examples/e07_own_robot_adapter.cpp", "int one;\n" * 150, 150, "under 150 lines"),
    ("files", "README.md", "one\nsee /wo" "rk/main\n", 2, "path of one machine"),
    ("files", "docs/site.md", "`/ho" "me/somebody`\n", 1, "path of one machine"),
    ("sizes", "libplan/src/engine/Engine.hpp", "#pragma once\nclass Engine\n{\n" + "    void Run();\n" * 61 + "};\n", 2,
     "61 methods"),
    ("sizes", "libplan/src/engine/Engine.hpp",
     "#pragma once\n\nclass Engine\n{\n" + "    std::map<int, std::function<void(int)>> _a{1};\n" * 21 + "};\n", 3, "21 members"),
    ("sizes", "apps/acsd/Robot.hpp", "#pragma once\nstruct Robot\n{\n" + "    int a = 0;\n" * 16 + "};\n", 2, "16 fields"),
    ("sizes", "apps/acsd/Outer.cpp", "class Outer::Impl\n{\n    struct Inner\n    {\n" + "        bool b;\n" * 16
     + "    };\n};\n", 3, "Inner has 16 fields"),
    ("sizes", "libplan/src/Long.cpp", "int one;\n" * 501, 1, "501 lines"),
    ("sizes", "libplan/src/engine/PlanEngine.hpp", "#pragma once\n#include \"../traffic/Router.hpp\"\n", 2,
     "engine -> traffic -> engine"),
    ("sizes", "scripts/sizes-exceeded.txt", "libplan/src/Gone.hpp Gone methods 70\n", 1, "remove its entry"),
    ("files", "docs/guide.md", "# Guide\n\n## Parking positions\n\n[keys](keys.md)\n", 5, "docs/keys.md, which does not exist"),
    ("files", "docs/guide.md", "# Guide\n\n## Parking positions\n[keys](reference/keys.md#key)\n", 4, "heading #key"),
    ("files", "docs/guide.md", "## Parking positions\n[code](reference/keys.md#not-a-heading)\n", 2, "heading #not-a-heading"),
    ("references", "libplan/src/engine/EngineAlarm.hpp",
     "#pragma once\ninline constexpr std::string_view ALARM_STORE = \"ACS-1005\";\n"
     "inline constexpr std::string_view ALARM_STALL = \"ACS-1009\";\n", 3, "ACS-1009 is not listed in docs/reference/alarms.md"),
    ("references", "docs/reference/alarms.md", "| `ACS-1005` |\n| `ARM-motorOff` |\n", 2, "ARM-motorOff is not defined"),
    ("references", "docs/reference/metrics.md", "| `acsd_link_up{link}`, `acsd_plans` |\n", 1, "acsd_plans is not defined"),
    ("translations", KOREAN_ALARMS, make_mark(ALARMS, "| Code |\n") + f"\n{KOREAN}", 1, "has changed since it was translated"),
    ("translations", KOREAN_ALARMS, KOREAN, 1, "names no version of its original"),
    ("translations", KOREAN_ALARMS, f"\n{MARK}\n{KOREAN}", 1, "names no version of its original"),
    ("translations", KOREAN_ALARMS, make_mark("docs/guide.md", RIGHT[ALARMS]) + f"\n{KOREAN}", 1, "names docs/guide.md"),
    ("translations", KOREAN_ALARMS, f"{MARK}\n{KOREAN}| `ACS-1005` |\n", 1, "not as many rows"),
    ("translations", KOREAN_ALARMS, f"{MARK}\n{KOREAN}\n## 코드\n", 1, "headings"),
    ("translations", KOREAN_ALARMS, f"{MARK}\n{KOREAN.replace('1004', '1003')}", 1, "`ACS-1003`, `ACS-1004`"),
    ("translations", KOREAN_ALARMS, f"{MARK}\n{KOREAN}\n```\none\n```\n", 1, "code blocks"),
    ("translations", KOREAN_ALARMS, f"{MARK}\n{RIGHT[ALARMS]}", 1, "no Korean"),
    ("translations", KOREAN_ALARMS, f"{MARK}\n{KOREAN}[처음](../../../README.md#run)\n", 1, "links to README.md; link to its translation"),
    ("translations", "docs/guide/ko/none.md", f"{MARK}\n없음\n", 1, "docs/guide/none.md, which this page would translate, does not exist"),
    ("translations", "docs/guide/get-started.md", "# One\n", 1, "no translation"),
    ("words", "docs/guide.md", "The alarm\ntells that\n", 2, "'tells': write report"),
    ("words", "README.md", "A robot waits for\never.\n", 1, "'for ever': write indefinitely"),
    ("words", "docs/guide.md", "1. Nobody\n   is notified.\n", 1, "'Nobody': write the operator"),
    ("words", "docs/guide.md", "one\n\n- two\n\n    three\n\nHomecomers wait.\n", 7, "'Homecomers': write safe state"),
    ("words", "docs/guide.md", "Lines are thinned.\n", 1, "write rate-limited"),
    ("words", "docs/guide.md", "```\ncode\n```\nReports a host that is none.\n", 4, "write invalid"),
    ("words", "docs/guide.md", "The text is no UTF-8.\n", 1, "write not valid UTF-8"),
    ("words", "docs/guide.md", "The job is given up.\n", 1, "write cancel"),
    ("words", "docs/guide.md", "It does not get on.\n", 1, "write make progress"),
    ("words", "docs/guide.md", "The plan goes on.\n", 1, "write continue"),
    ("words", "docs/guide.md", "It is taken up again.\n", 1, "write accept, resume"),
    ("words", "docs/guide.md", "Time to look around.\n", 1, "write check"),
    ("words", "docs/guide.md", "`a` Every mistake `b`\n", 1, "write error"),
    ("words", "docs/guide.md", "There is no objection.\n", 1, "write rejection reason"),
    ("members", "libacs-core/src/Box.cpp", "class Box\n{\n    int Get();\n\npublic:\n    Box();\n};\n", 6,
     "a constructor of Box is after a private method"),
    ("members", "libacs-core/src/Box.cpp", "class Box\n{\n    int _a = 0;\n\npublic:\n    using Size = int;\n};\n", 6,
     "a public type or constant of Box is after data"),
    ("members", "libacs-core/src/Box.cpp", "class Box\n{\npublic:\n    Box();\n\nprivate:\n    std::map<int, int> _a{{1, 2}};\n};\n", 7,
     "data of Box is after a constructor"),
    ("members", "libacs-core/src/Box.cpp", "class Box\n{\nprivate:\n    void Run() { One(); }\npublic:\n    int Get() const;\n};\n",
     6, "a public method of Box is after a private method"),
    ("members", "libacs-core/src/Box.cpp", "void Open(int size,\n          const std::optional<int>& limit);\n", 1,
     "parameter limit may be null"),
    ("members", "libacs-core/src/Box.cpp", "int Open(Box* box)\n{\n    return 1;\n}\n", 1, "parameter box may be null"),
    ("members", "tests/unit/Box.cpp", "int one;\nstd::string orderId;\n", 2, "orderId: an abbreviation"),
    ("words", "docs/guide.md", "As long as it is there\n", 1, "write while"),
    ("words", "docs/guide.md", "So many controllers\n", 1, "write number of"),
    ("words", "docs/guide.md", "The robot stands at a node; it stands for AMR.\n", 1, "write is stationary"),
    ("words", "docs/guide.md", "It drove without leave.\n", 1, "write without a reservation"),
    ("words", "docs/guide.md", "[tells](reference/keys.md)\n", 1, "'tells'"),
    ("words", "examples/site/acsd.toml", "[log]\nlevel = \"info\"  # what is told\n", 2, "'told': write report"),
    ("words", "scripts/setup", "# one\n# two goes\n# on\n", 2, "write continue"),
    ("words", "tests/install/consumer_Core.cpp", "int tells = 1; // the plan\n// is told so\n", 2, "'told': write report"),
    ("words", "tests/install/consumer_Core.cpp", "const char* text = \"a mistake\";\n", 1, "'mistake': write error"),
    ("words", "libplan/json/include/acs/plan_json/PlanFields.hpp", "// a doubtful job\n", 1, "'doubtful': write unresolved"),
    ("words", "libplan/src/Engine.cpp", "const char* key = \"doubtful\";\n", 1, "'doubtful': write unresolved"),
]

ACCEPTED = [
    ("api", "libplan/include/acs/plan/Box.hpp",
     "#pragma once\n#define BOX(a) \\\n    Use(a)\nclass Other;\nenum class EBox\n{\n    One,\n};\n\nstruct Box\n{\n"
     "    std::function<void(int)> run;\n    int operators = 1;\n    Box() = default;\n    bool operator==(const Box&) const = default;\n"
     "    int Get() const { return Use(1); }\n};\n\ntemplate <typename T>\nvoid Run(T one);\ninline int Two();\n"
     "using Call = int (*)(int);\nPair(int) -> Pair<int>;\n[[nodiscard]] ACS_API Box MakeBox();\n"
     "class ACS_API Shown\n{\n    class ACS_HIDDEN Impl;\n    class Inner;\n    class Inner\n    {\n    };\n    void Run();\n};\n"),
    ("api", "libplan/src/Box.hpp", "#pragma once\nclass Box\n{\n    void Run();\n};\n"),
    ("sizes", "apps/acsd/RobotOptions.hpp",
     "#pragma once\nstruct RobotOptions\n{\n" + "    int a = 0;\n" * 30 + "};\n"),
    ("sizes", "apps/acsd/Robot.hpp", "#pragma once\nclass Robot\n{\n    static constexpr int A = 1;\n    using B = int;\n"
     + "    void Run() { int one; int two; }\n" * 60 + "    int _a = 0;\n" * 20 + "};\n"),
    ("files", "libplan/src/Engine.hpp", "#pragma once\nclass IStore\n{\n};\n\nstruct Change\n{\n};\n\nclass Engine;\n\n"
                                        "class Engine final : public IStore\n{\n    class Inner\n    {\n    };\n};\n"),
    ("files", "libplan/include/acs/plan/Reports.hpp", "#pragma once\nstruct PlanReport\n{\n};\n\nstruct JobReport\n{\n};\n"),
    ("files", "libplan/src/PlanEngine.Recovery.cpp", "// /tmp/acs.XXXXXX and https://example.org/home/page\n"),
    ("files", "libplan/src/Text.hpp", "#pragma once\nnamespace ACS::Detail\n{\n\nclass Hidden\n{\n};\n\n}\n\n"
                                      "class Text\n{\n};\n"),
    ("files", "examples/e07_own_robot_adapter.cpp", "int one;\n" * 149),
    ("files", "examples/e09_small_acs.cpp", "int one;\n" * 500),
    ("layers", "libplan/src/Engine.cpp", "const char* text = \"steady_clock::now()\"; // steady_clock::now()\n"),
    ("members", "libacs-core/src/Box.cpp", "class Box final : public IBox\n{\npublic:\n    enum class EKind\n    {\n        One,\n    };\n"
     "    static constexpr int LIMIT = 1;\n\nprivate:\n    class Impl;\n    std::unique_ptr<Impl> _impl{new Impl()};\n\npublic:\n"
     "    explicit Box(int* sizeOrNull);\n    ~Box();\n    Box& operator=(const Box&) = delete;\n    bool operator==(const Box&) const;\n"
     "    int Get(const char* name, std::optional<int>& out);\n\nprotected:\n    int Read();\n\nprivate:\n    void Run() {}\n};\n"),
    ("members", "libacs-core/src/Box.cpp", "// orderId\nint HttpCode = GetURL(\"mapId\", ParseRapidJson);\n"),
    ("members", "libacs-core/src/Box.cpp", "struct Pair\n{\n    int Sum();\n    int one = 0;\n};\n"
     "void Run() { if (const std::optional<int> next = Get()) { Use(2 * next); } }\n"),
    ("translations", KOREAN_ALARMS, f"{MARK}\r\n{KOREAN}"),
    ("translations", "docs/guide/other.md", "# A page that needs no translation\n"),
    ("words", "docs/guide.md", "`nobody` stands for [it](told.md); a look-up, on-going, wished. They mistake the order for another.\n"),
    ("words", "tests/install/consumer_Core.cpp", "int mistake = nobody(told); // counts\n"),
    ("words", "libplan/json/include/acs/plan_json/PlanFields.hpp", "Optional(\"doubtful\", &Work::bUnresolved);\n"),
]


def write_tree(folder, files):
    for path, content in files.items():
        place = os.path.join(folder, path)
        os.makedirs(os.path.dirname(place), exist_ok=True)
        with open(place, "w", encoding="utf-8", newline="") as file:
            file.write(content)


def check(kind, files):
    with tempfile.TemporaryDirectory() as folder:
        write_tree(folder, files)
        return list(CHECKS[kind].check_tree(folder))


def check_program(kind, files):
    """The same over the command line: exit code and lines."""
    with tempfile.TemporaryDirectory() as folder:
        write_tree(folder, files)
        done = subprocess.run([sys.executable, os.path.join(ROOT, "scripts", f"check_{kind}.py"), "--root", folder],
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        return done.returncode, done.stdout.splitlines()


def main():
    failures = []
    for kind in CHECKS:
        path, content = next((path, content) for name, path, content, *_ in PLANTED if name == kind)
        for files, expected in ((RIGHT, 0), ({**RIGHT, path: content}, 1)):
            code, lines = check_program(kind, files)
            if code != expected or len(lines) != expected:
                failures.append(f"check_{kind}.py must end with {expected}, not {code}, and as many lines: {lines}")
    for kind, path, content, line, sentence in PLANTED:
        lines = check(kind, {**RIGHT, path: content})
        if len(lines) != 1 or not lines[0].startswith(f"{path}:{line}: ") or sentence not in lines[0]:
            failures.append(f"check_{kind} must report {path}:{line} with '{sentence}', and nothing else, for\n"
                            f"{content}but reports {lines}")
    for kind, path, content in ACCEPTED:
        lines = check(kind, {**RIGHT, path: content})
        if lines:
            failures.append(f"check_{kind} must accept {path}:\n{content}but reports {lines}")
    for failure in failures:
        print(failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
