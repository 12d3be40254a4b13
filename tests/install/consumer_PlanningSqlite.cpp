// needs: SQLiteCpp
#include <acs/plan_sqlite/SqlitePlanStore.hpp>

#include <cstdio>

int main()
{
    const auto store = ACS::Planning::SqlitePlanStore::Open("/nonexistent/acsd.db");
    const std::string sentence = store.has_value() ? std::string() : ACS::Core::Describe(store.error());
    std::puts(sentence.c_str());
    return sentence.find("/nonexistent/acsd.db") == std::string::npos ? 1 : 0;
}
