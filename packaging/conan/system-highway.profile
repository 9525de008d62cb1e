# A profile for `conan create` without ConanCenter: Highway is the package of the system (Debian: libhwy-dev).
include(default)

[settings]
compiler.cppstd=20

[platform_requires]
highway/1.0.3
