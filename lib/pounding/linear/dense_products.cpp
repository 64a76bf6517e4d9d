#include <pounding/linear/dense_products.hpp>

#include <petscmat.h>

#include <algorithm>

#include <pounding/linear/column_sums.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/petsc/library_lock.hpp>

namespace pounding::petsc {
namespace {

using Eigen::Index;

constexpr Index many = 1000;

bool by_blas(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return std::max({a.rows(), a.cols(), b.cols()}) > many && a.size() > 0 && b.size() > 0;
}

// Columns of Eigen as a PETSc matrix, whose products use BLAS.
class Dense {
 public:
  explicit Dense(const Eigen::Ref<const Eigen::MatrixXd>& values) {
    const auto size = [](Index count) { return static_cast<PetscInt>(count); };
    // PETSc only reads the factors of a product.
    check(MatCreateSeqDense(PETSC_COMM_SELF, size(values.rows()), size(values.cols()),
                            const_cast<double*>(values.data()), &matrix_));
    check(MatDenseSetLDA(matrix_, size(values.outerStride())));
  }
  ~Dense() { MatDestroy(&matrix_); }
  Dense(const Dense&) = delete;
  Dense& operator=(const Dense&) = delete;
  Mat get() const { return matrix_; }

 private:
  Mat matrix_ = nullptr;
};

// C = A B or A^T B.
void multiply(bool transposed, const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b,
              Eigen::Ref<Eigen::MatrixXd> c) {
  const LibraryLock lock;
  const Dense of_a(a), of_b(b), of_c(c);
  Mat made = of_c.get();
  check(MatProductCreateWithMat(of_a.get(), of_b.get(), nullptr, made));
  check(MatProductSetType(made, transposed ? MATPRODUCT_AtB : MATPRODUCT_AB));
  check(MatProductSetFromOptions(made));
  check(MatProductSymbolic(made));
  check(MatProductNumeric(made));
}

}  // namespace

Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  if (!by_blas(a, b)) return summed_product(a, b);
  Eigen::MatrixXd made(a.rows(), b.cols());
  multiply(false, a, b, made);
  return made;
}

Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  if (!by_blas(a, b)) return summed_product(a.transpose(), b);
  Eigen::MatrixXd made(a.cols(), b.cols());
  multiply(true, a, b, made);
  return made;
}

Eigen::MatrixXd symmetric_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  constexpr Index together = 48, together_by_blas = 192;
  const bool blas = by_blas(a, b);
  const Eigen::MatrixXd rows = blas ? Eigen::MatrixXd() : Eigen::MatrixXd(a.transpose());
  const Index count = b.cols(), step = blas ? together_by_blas : together;
  Eigen::MatrixXd made = Eigen::MatrixXd::Zero(count, count);
  for (Index j = 0; j < count; j += step) {
    const Index columns = std::min(step, count - j);
    if (blas)
      multiply(true, a.rightCols(count - j), b.middleCols(j, columns), made.block(j, j, count - j, columns));
    else
      add_products({rows.data() + j, count - j, rows.cols(), rows.rows()},
                   {b.col(j).data(), b.rows(), columns, b.rows()}, made.col(j).data() + j, count);
  }
  made.triangularView<Eigen::StrictlyUpper>() = made.transpose();
  return made;
}

}  // namespace pounding::petsc
