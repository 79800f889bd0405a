// SPDX-License-Identifier: MIT
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "tests/support/gl_fixture.h"

#include <cstdio>

#ifdef __SANITIZE_ADDRESS__
#include <dlfcn.h>
#endif

namespace {

/// Names the test cases that OpenGL complained in.
class GlListener final : public doctest::IReporter {
public:
    explicit GlListener(const doctest::ContextOptions&) {}

    void test_case_start(const doctest::TestCaseData& test) override {
        name_ = test.m_name;
        before_ = afterglow::unexpectedGlMessages();
    }
    void test_case_end(const doctest::CurrentTestCaseStats&) override {
        const int count = afterglow::unexpectedGlMessages() - before_;
        if (count > 0)
            std::fprintf(stderr, "FAILED: OpenGL complained %d times in: %s\n", count, name_);
    }

    void report_query(const doctest::QueryData&) override {}
    void test_run_start() override {}
    void test_run_end(const doctest::TestRunStats&) override {}
    void test_case_reenter(const doctest::TestCaseData&) override {}
    void test_case_exception(const doctest::TestCaseException&) override {}
    void subcase_start(const doctest::SubcaseSignature&) override {}
    void subcase_end() override {}
    void log_assert(const doctest::AssertData&) override {}
    void log_message(const doctest::MessageData&) override {}
    void test_case_skipped(const doctest::TestCaseData&) override {}

private:
    const char* name_ = "";
    int before_ = 0;
};

REGISTER_LISTENER("gl", 1, GlListener);

} // namespace

#ifdef __SANITIZE_ADDRESS__
// What Mesa does not free is not ours. EGL unloads its driver, and a leak inside a module that is
// gone has no name to be told apart by: so keep the driver.
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libOSMesa.so\nleak:swrast_dri.so\nleak:libEGL\nleak:libLLVM\n";
}
namespace {
const void* const keptDriver =
    dlopen("/usr/lib/x86_64-linux-gnu/dri/swrast_dri.so", RTLD_LAZY | RTLD_NODELETE);
} // namespace
#endif

int main(int argc, char** argv) {
    doctest::Context context(argc, argv);
    const int result = context.run();
    // Now, not after main(): drivers tear themselves down then.
    afterglow::releaseTestContext();
    if (result == 0 && afterglow::unexpectedGlMessages() > 0)
        return 1;
    return result;
}
